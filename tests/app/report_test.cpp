// Measurements on a server that runs, as people do them on the league's.
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/fake_server.h"
#include "app/program.h"

namespace nonet::app {
namespace {

class ReportCommand : public testing::Test {
 protected:
  // The embedded server in lock-step, on any free ports.
  void serve() {
    ASSERT_TRUE(server_.says("monitors on port \\d+")) << server_.output();
    port_ = std::to_string(server_.numberAfter("agents on port "));
    monitorPort_ = std::to_string(server_.numberAfter("monitors on port "));
  }
  std::vector<std::string> there() const {
    return {"--tcp", "--port", port_, "--monitor-port", monitorPort_};
  }

  nlohmann::json report(std::vector<std::string> arguments, const std::vector<std::string>& more = {}) {
    arguments.insert(arguments.end(), more.begin(), more.end());
    arguments.emplace_back("--json");
    const std::string file = folder_.file("report.json");
    Program program(arguments, file);
    EXPECT_EQ(program.wait(), 0) << program.output();
    const std::string text = program.output();  // progress and JSON
    return nlohmann::json::parse(text.substr(text.find('{')), nullptr, false);
  }
  TestFolder folder_{"nonet_report_test"};

 private:
  Program server_{{"serve", "--sync", "--port", "0", "--monitor-port", "0"}, folder_.file("server.txt")};
  std::string port_;
  std::string monitorPort_;
};

TEST_F(ReportCommand, KicksOnAServerGoAsFarAsInProcess) {
  serve();
  const std::vector<std::string> kicks = {"kick-report", "--type", "2",      "--kick", "kick_power",
                                          "--trials",    "10",     "--seed", "11"};
  const nlohmann::json inProcess = report(kicks)["kick_power"];
  const nlohmann::json onServer = report(kicks, there())["kick_power"];
  EXPECT_EQ(onServer["trials"], 10);
  EXPECT_LE(onServer["falls"].get<double>(), 0.1);
  for (const auto& [key, share] : {std::pair("distance_m", 0.15), {"apex_m", 0.3}, {"time_s", 0.15}}) {
    const double expected = inProcess[key]["median"].get<double>();
    EXPECT_NEAR(onServer[key]["median"].get<double>(), expected, share * expected) << key;
  }
}

TEST_F(ReportCommand, SaysWhereItFoundNoServer) {
  Program program({"kick-report", "--trials", "1", "--tcp", "--port", "1"}, folder_.file("nobody.txt"));
  EXPECT_EQ(program.wait(), 1);
  EXPECT_TRUE(program.says("127.0.0.1:1: .*is a server running there")) << program.output();
  Program without({"kick-report", "--trials", "1", "--port", "3100"}, folder_.file("without.txt"));
  EXPECT_EQ(without.wait(), 1);
  EXPECT_TRUE(without.says("--port.*--tcp")) << without.output();
}

// Somebody listens there, but is no server.
TEST_F(ReportCommand, DoesNotWaitForeverWhereNobodySpeaks) {
  const FakeServer silent;
  const std::string port = std::to_string(silent.port());
  Program agent({"kick-report", "--trials", "1", "--tcp", "--port", port, "--monitor-port", port},
                folder_.file("silent.txt"));
  EXPECT_EQ(agent.wait(), 1);
  EXPECT_TRUE(agent.says("127.0.0.1:" + port + ": no message in 10 s.*--port")) << agent.output();
  serve();
  std::vector<std::string> arguments = {"kick-report", "--kick", "kick_power", "--trials", "1"};
  const std::vector<std::string> place = there();
  arguments.insert(arguments.end(), place.begin(), place.end());
  arguments.back() = port;
  Program monitor(arguments, folder_.file("blind.txt"));
  EXPECT_EQ(monitor.wait(), 1);
  EXPECT_TRUE(monitor.says("127.0.0.1:" + port + ": .*--monitor-port")) << monitor.output();
}

}  // namespace
}  // namespace nonet::app
