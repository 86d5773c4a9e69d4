// `nonet explain` where an agent has come back to its server and has several logs.
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "nonet/agent/agent_setup.h"
#include "nonet/protocol/log_file.h"

#include "app/fake_server.h"
#include "app/program.h"

namespace nonet::app {
namespace {

using testing::HasSubstr;

// A second of the game that begins then.
void writeLife(const std::string& path, int unum, double begin) {
  agent::AgentChoice choice;
  choice.unum = unum;
  choice.team = "Test";
  protocol::LogWriter log(path, agent::logHeader(agent::makeAgentSettings(choice, NONET_SOURCE_DIR), "test"));
  for (int cycle = 0; cycle < 50; ++cycle) {
    std::string message = standingMessage(1.0 + 0.02 * cycle, fmt::format("(unum {}) (team left) ", unum));
    log.received(message.replace(message.find("0.00) (pm"), 4, fmt::format("{:.2f}", begin + 0.02 * cycle)));
  }
}

TEST(Explain, LooksIntoAllLivesOfTheRobot) {
  const TestFolder folder("nonet_explain_lives");
  writeLife(folder.file("3.zst"), 3, 10.0);
  writeLife(folder.file("3.2.zst"), 3, 40.0);
  writeLife(folder.file("3.3.zst"), 3, 40.5);
  { protocol::LogWriter(folder.file("3.4.zst"), protocol::LogReader(folder.file("3.zst")).header().value()); }
  const auto explain = [&](const std::string& at) {
    Program program(
        {"explain", folder.file(""), "--unum", "3", "--team", "Test", "--at", at, "--data", NONET_SOURCE_DIR},
        folder.file("said.txt"));
    const int exit = program.wait();
    return std::pair(exit, program.output());
  };
  for (const std::string at : {"10.50", "40.20", "41.30"}) {
    const auto [exit, output] = explain(at);
    EXPECT_EQ(exit, 0) << output;
    EXPECT_THAT(output, HasSubstr("Test 3 at " + at + " s of the game"));
  }
  EXPECT_THAT(explain("40.80").second, HasSubstr("both hold 40.80 s of the game: give the file"));
  EXPECT_THAT(explain("25").second, HasSubstr("nothing at 25.00 s"));
  writeLife(folder.file("4.zst"), 4, 10.0);
  Program several({"explain", folder.file(""), "--at", "10.5", "--data", NONET_SOURCE_DIR},
                  folder.file("said.txt"));
  EXPECT_EQ(several.wait(), 1);
  EXPECT_THAT(several.output(), HasSubstr("name one with --unum and --team"));
}

}  // namespace
}  // namespace nonet::app
