#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <thread>

#include <asio.hpp>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <signal.h>
#include <unistd.h>

#include "app/fake_server.h"
#include "app/program.h"

namespace nonet::app {
namespace {

namespace fs = std::filesystem;

class MatchCommand : public testing::Test {
 protected:
  MatchCommand() : folder_(fs::temp_directory_path() / ("nonet_match_test_" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
  }
  ~MatchCommand() override { fs::remove_all(folder_); }

  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  std::string bytes(const std::string& name) const {
    std::ifstream stream(file(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  nlohmann::json json(const std::string& name) const { return nlohmann::json::parse(bytes(name)); }

  fs::path folder_;
};

TEST_F(MatchCommand, SameSeedGivesIdenticalLogsAndTheSameMatchInOneProcess) {
  const std::vector<std::string> common = {"match",           "--players", "2",      "--minutes", "0.1",
                                           "--kick-off-wait", "1",         "--seed", "11"};
  for (const std::string name : {"a", "b", "here"}) {
    std::vector<std::string> arguments = common;
    arguments.insert(arguments.end(), {"--json", file(name + ".json"), "--monitor-log", file(name + ".mon")});
    if (name == "here") {
      arguments.push_back("--in-process");
    } else {
      arguments.insert(arguments.end(), {"--logs", file(name)});
    }
    Program program(arguments, file(name + ".txt"));
    ASSERT_EQ(program.wait(), 0) << program.output();
  }
  EXPECT_TRUE(json("a.json")["flawless"]);
  EXPECT_EQ(json("a.json")["signature"], json("b.json")["signature"]);
  EXPECT_EQ(json("a.json")["signature"], json("here.json")["signature"]);
  EXPECT_GT(bytes("a.mon").size(), 10000U);
  EXPECT_EQ(bytes("a.mon"), bytes("here.mon"));
  int logs = 0;
  for (const auto& entry : fs::directory_iterator(file("a"))) {
    const std::string name = entry.path().filename().string();
    EXPECT_EQ(bytes("a/" + name), bytes("b/" + name)) << name;
    ++logs;
  }
  EXPECT_EQ(logs, 4);

  Program replay({"replay", "--json", file("a/Nonet_1.zst"), file("a/Guests_2.zst")}, file("replay.txt"));
  EXPECT_EQ(replay.wait(), 0) << replay.output();
  std::istringstream lines(replay.output());
  int reports = 0;
  for (std::string line; std::getline(lines, line); ++reports) {
    const auto report = nlohmann::json::parse(line);
    EXPECT_EQ(report["effector_differences"], 0);
    EXPECT_EQ(report["unknown"], 0);
    EXPECT_EQ(report["lost_cycles"], 0);
  }
  EXPECT_EQ(reports, 2);
}

// One agent killed, one stopped for a while, and strangers that send random bytes or half a message and
// leave.
TEST_F(MatchCommand, PlaysOnWhenAgentsAreHarmed) {
  Program program({"match", "--realtime", "--players", "2", "--minutes", "0.1", "--kick-off-wait", "2",
                   "--json", file("harm.json")},
                  file("harm.txt"));
  int port = 0;
  for (int i = 0; i < 200 && program.output().find("BeforeKickOff") == std::string::npos; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  const std::string text = program.output();
  const std::size_t at = text.find("agents on port ");
  ASSERT_NE(at, std::string::npos) << text;
  port = std::stoi(text.substr(at + 15));
  const auto nonet = program.agents("Nonet");
  const auto guests = program.agents("Guests");
  ASSERT_EQ(nonet.size(), 2U);
  ASSERT_EQ(guests.size(), 2U);
  ::kill(nonet.at(2), SIGKILL);
  ::kill(guests.at(1), SIGSTOP);

  asio::io_context io;
  asio::ip::tcp::socket garbage(io);
  garbage.connect({asio::ip::address_v4::loopback(), static_cast<asio::ip::port_type>(port)});
  asio::write(garbage, asio::buffer(std::string("\0\0\0\x08)))((((\xff\xfe\xfd\xfc\xfb", 17)));
  asio::ip::tcp::socket half(io);
  half.connect({asio::ip::address_v4::loopback(), static_cast<asio::ip::port_type>(port)});
  asio::write(half, asio::buffer(std::string("\0\0\0\x50(scene rsg", 14)));
  half.close();

  std::this_thread::sleep_for(std::chrono::seconds(2));
  ::kill(guests.at(1), SIGCONT);
  EXPECT_EQ(program.wait(), 0) << program.output();
  const auto result = json("harm.json");
  EXPECT_TRUE(result["finished"]);
  EXPECT_FALSE(result["flawless"]);
  for (const auto& player : result["players"]) {
    const bool killed = player["team"] == "Nonet" && player["unum"] == 2;
    EXPECT_EQ(player["gone"], killed);
    EXPECT_EQ(player["ending"].get<std::string>().empty(), !killed) << player["ending"];
  }
  EXPECT_NE(program.output().find("Nonet_2 has ended: killed by signal 9"), std::string::npos)
      << program.output();
}

TEST_F(MatchCommand, OneTeamMayPlayAlone) {
  Program program({"match", "--in-process", "--alone", "--players", "2", "--minutes", "0.05",
                   "--kick-off-wait", "0.5", "--json", file("alone.json")},
                  file("alone.txt"));
  EXPECT_EQ(program.wait(), 0) << program.output();
  const auto result = json("alone.json");
  EXPECT_TRUE(result["flawless"]);
  EXPECT_EQ(result["players"].size(), 2U);
}

TEST_F(MatchCommand, WhatARobotThoughtIsExplainedFromItsLogs) {
  Program match({"match", "--players", "2", "--minutes", "0.05", "--kick-off-wait", "0.5", "--logs",
                 file("logs"), "--json", file("m.json")},
                file("match.txt"));
  ASSERT_EQ(match.wait(), 0) << match.output();
  Program one({"explain", file("logs"), "--team", "Nonet", "--unum", "2", "--at", "0.5"},
              file("explain.txt"));
  EXPECT_EQ(one.wait(), 0) << one.output();
  EXPECT_NE(one.output().find("Nonet 2 at 0.5"), std::string::npos) << one.output();

  const std::string log = file("logs/Nonet_2.zst");
  Program other({"explain", log, "--unum", "1", "--at", "0.5"}, file("other.txt"));
  EXPECT_EQ(other.wait(), 1);
  EXPECT_NE(other.output().find(log + " is the log of Nonet 2"), std::string::npos) << other.output();
  fs::resize_file(log, fs::file_size(log) - 100);
  Program torn({"explain", log, "--at", "0.5"}, file("torn.txt"));
  EXPECT_EQ(torn.wait(), 0);
  for (const std::string& words : {log + ": the file was not closed", std::string("Nonet 2 at 0.5")})
    EXPECT_NE(torn.output().find(words), std::string::npos) << torn.output();
}

// A disk that is full, for the monitor log and for a player's recordings.
TEST_F(MatchCommand, RecordingsThatFindNoRoomAreToldAndTheMatchIsPlayed) {
  for (const bool inProcess : {true, false}) {
    const std::string folder = file(inProcess ? "here" : "there");
    fs::create_directories(folder);
    for (const char* name : {"Nonet_1.trace", "Nonet_1.zst"})
      fs::create_symlink("/dev/full", fs::path(folder) / name);
    std::vector<std::string> arguments = {"match",     "--alone",        "--players",       "1",
                                          "--minutes", "0.02",           "--kick-off-wait", "0.2",
                                          "--trace",   folder,           "--monitor-log",   "/dev/full",
                                          "--json",    file("full.json")};
    if (inProcess) {
      arguments.emplace_back("--in-process");
    } else {
      arguments.insert(arguments.end(), {"--logs", folder});
    }
    Program program(arguments, file("full.txt"));
    EXPECT_EQ(program.wait(), 1) << program.output();
    const auto result = json("full.json");
    EXPECT_TRUE(result["finished"]);
    EXPECT_FALSE(result["flawless"]);
    std::vector<std::string> names = {"/dev/full", folder + "/Nonet_1.trace"};
    if (!inProcess) names.insert(names.begin() + 1, folder + "/Nonet_1.zst");
    ASSERT_EQ(result["warnings"].size(), names.size()) << result["warnings"];
    for (std::size_t i = 0; i < names.size(); ++i) {
      EXPECT_TRUE(result["warnings"][i].get<std::string>().starts_with(names[i] + ": recording stops"))
          << result["warnings"][i];
      EXPECT_NE(program.output().find("warning: " + names[i]), std::string::npos) << program.output();
    }
  }
}

// On an empty field nothing happens; who asked for a match must hear of it.
TEST_F(MatchCommand, SaysWhoWasRefused) {
  for (const bool inProcess : {true, false}) {
    std::vector<std::string> arguments = {
        "match", "--players",           "2",      "--minutes",   "0.02", "--kick-off-wait", "0.5",
        "--set", "MaxRobotTypeCount=0", "--json", file("m.json")};
    if (inProcess) arguments.emplace_back("--in-process");
    Program program(arguments, file("refused.txt"));
    EXPECT_EQ(program.wait(), 1) << inProcess;
    EXPECT_NE(program.output().find(inProcess ? "refused by the server" : "the server did not take"),
              std::string::npos)
        << program.output();
  }
}

TEST_F(MatchCommand, PlayWithoutServerEndsWithTwo) {
  const ClosedPort nobody;
  Program program({"play", "--port", std::to_string(nobody.port()), "--wait", "0.2"}, file("play.txt"));
  EXPECT_EQ(program.wait(), 2);
  EXPECT_NE(program.output().find("no server"), std::string::npos);
}

// Stopped in the middle, with the result so far in the file as over TCP.
TEST_F(MatchCommand, AMatchThatIsStoppedKeepsItsResult) {
  for (const bool here : {true, false}) {
    for (const int signal : {SIGTERM, SIGINT}) {
      std::vector<std::string> arguments = {
          "match",         "--players",        "1", "--minutes", "60", "--json", file("stopped.json"),
          "--monitor-log", file("stopped.mon")};
      if (here) arguments.emplace_back("--in-process");
      fs::remove(file("stopped.mon"));
      Program program(arguments, file("stopped.txt"));
      for (int i = 0;
           i < 200 && (!fs::exists(file("stopped.mon")) || fs::file_size(file("stopped.mon")) < 50000); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
      ::kill(program.pid(), signal);
      EXPECT_EQ(program.wait(), 1) << program.output();
      const auto result = json("stopped.json");
      EXPECT_FALSE(result["finished"]);
      EXPECT_GT(result["cycles"], 10);
      fs::remove(file("stopped.json"));
    }
  }
}

TEST_F(MatchCommand, SaysBeforeTheMatchThatTheResultCannotBeWritten) {
  Program program({"match", "--in-process", "--minutes", "60", "--json", folder_.string()}, file("x.txt"));
  EXPECT_EQ(program.wait(), 1);
  EXPECT_NE(program.output().find("--json " + folder_.string() + ": cannot be written"), std::string::npos);
}

TEST_F(MatchCommand, TeamNamesThatWouldFailLateAreRefused) {
  for (const std::string& name :
       std::vector<std::string>{"A/B", "A B", "A(B", "A'B", "A\"B", std::string(65, 'x')}) {
    Program program({"match", "--in-process", "--minutes", "60", "--left", name, "--json", file("x.json")},
                    file("x.txt"));
    EXPECT_EQ(program.wait(), 1) << name;
    EXPECT_NE(program.output().find("team '" + name + "'"), std::string::npos) << program.output();
  }
}

// The clock of the game, without the waits before the halves: nobody stands longer than the game lasts.
TEST_F(MatchCommand, NobodyStandsLongerThanTheGameLasts) {
  Program program({"match", "--in-process", "--players", "1", "--minutes", "0.05", "--kick-off-wait", "2",
                   "--json", file("stand.json")},
                  file("stand.txt"));
  EXPECT_EQ(program.wait(), 0) << program.output();
  const auto result = json("stand.json");
  for (const auto& player : result["players"]) {
    EXPECT_LE(player["standing_after_kickoff_s"], result["game_time_s"]);
    if (player["falls"] == 0) {
      EXPECT_EQ(player["standing_after_kickoff_s"], result["game_time_s"]);
    }
  }
}

// Values of both kinds in one option, the same in one process and over TCP.
TEST_F(MatchCommand, SetsServerAndAgents) {
  const std::vector<std::string> common = {
      "match", "--players",       "1",   "--alone",       "--minutes",
      "0.05",  "--kick-off-wait", "0.5", "--monitor-log", file("set.mon")};
  std::vector<std::string> signatures;
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{},
        {"--in-process", "--set", "world.usePoseFit=false", "--set", "world.useParticleFilter=false"},
        {"--set", "world.usePoseFit=false", "--set", "world.useParticleFilter=false"}}) {
    std::vector<std::string> arguments = common;
    arguments.insert(arguments.end(), {"--json", file("set.json")});
    arguments.insert(arguments.end(), more.begin(), more.end());
    Program program(arguments, file("set.txt"));
    EXPECT_EQ(program.wait(), 0) << program.output();
    signatures.push_back(json("set.json")["signature"]);
  }
  EXPECT_NE(signatures[0], signatures[1]);
  EXPECT_EQ(signatures[1], signatures[2]);
  Program server({"match", "--in-process", "--set", "RuleHalfTimes=3", "--json", file("x.json")},
                 file("x.txt"));
  EXPECT_EQ(server.wait(), 1);
  EXPECT_NE(server.output().find("RuleHalfTime"), std::string::npos) << server.output();
}

TEST_F(MatchCommand, TellsWhyAMatchCannotBegin) {
  std::ofstream(file("wrong.toml")) << "nosuchparameter = 1\n";
  Program program({"match", "--players", "1", "--left-params", file("wrong.toml"), "--json", file("x.json")},
                  file("wrong.txt"));
  EXPECT_EQ(program.wait(), 1);
  EXPECT_NE(program.output().find("nosuchparameter"), std::string::npos) << program.output();
}

}  // namespace
}  // namespace nonet::app
