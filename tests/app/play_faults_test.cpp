// `nonet play` where the machine is slow, the server silent or the disk full.
#include <chrono>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/fake_server.h"
#include "app/program.h"

namespace nonet::app {
namespace {

using testing::HasSubstr;
using testing::StartsWith;
using Clock = std::chrono::steady_clock;

constexpr double kBusy = 20.0;  // s; a machine may do much else beside, but nothing here waits for long

double secondsSince(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

class PlayFaults : public testing::Test {
 protected:
  std::unique_ptr<Program> play(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(),
                     {"play", "--port", std::to_string(server.port()), "--unum", "3", "--team", "Test"});
    return std::make_unique<Program>(arguments, folder.file("play.txt"));
  }
  /// The process sleeps, as under load, until both its timer is due and a message is there.
  void wakeUpTo(const Program& program, const std::string& message) {
    ::kill(program.pid(), SIGSTOP);
    int status = 0;
    ASSERT_EQ(::waitpid(program.pid(), &status, WUNTRACED), program.pid());
    ASSERT_TRUE(WIFSTOPPED(status));
    while (server.receive(0.05)) continue;  // what it had sent before
    server.send(message);
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    ::kill(program.pid(), SIGCONT);
  }

  TestFolder folder{"nonet_play_faults"};
  FakeServer server;
};

// The first message and the timer that watches for silence come together: the robot must introduce itself and
// from then on only answer, on the first connection and on one made anew.
TEST_F(PlayFaults, AMessageThatComesWithTheTimerEndsTheWatchForSilence) {
  const auto program = play({});
  server.accept();
  EXPECT_THAT(server.receive().value_or(""), StartsWith("(scene"));
  wakeUpTo(*program, standingMessage(1.0));
  EXPECT_THAT(server.receive().value_or(""), StartsWith("(init (unum 3)"));
  EXPECT_EQ(server.receive(1.0), std::nullopt) << "it still watches for silence";
  server.close();
  EXPECT_EQ(program->wait(), 3);
}

TEST_F(PlayFaults, SoDoesItOnALaterConnection) {
  const auto program = play({});
  server.accept();
  while (server.receive()) continue;  // silence, until it connects anew
  server.accept();
  EXPECT_THAT(server.receive().value_or(""), StartsWith("(scene"));
  wakeUpTo(*program, standingMessage(1.0));
  EXPECT_THAT(server.receive().value_or(""), StartsWith("(init (unum 3)"));
  EXPECT_EQ(server.receive(1.0), std::nullopt) << "it still watches for silence";
  server.send(standingMessage(1.02, "(unum 3) (team left) "));
  EXPECT_TRUE(server.receive().has_value());
  server.close();
  EXPECT_EQ(program->wait(), 3);
  EXPECT_TRUE(program->says("as Test 3"));
}

TEST_F(PlayFaults, WaitsAsLongAsToldForAServer) {
  const ClosedPort nobody;
  const auto begin = Clock::now();
  Program program({"play", "--port", std::to_string(nobody.port()), "--wait", "2"}, folder.file("none.txt"));
  EXPECT_EQ(program.wait(), 2);
  EXPECT_GE(secondsSince(begin), 2.0);
  EXPECT_LT(secondsSince(begin), kBusy);
  EXPECT_THAT(program.output(), HasSubstr("after 2."));
}

TEST_F(PlayFaults, WaitsNoLongerForASilentServer) {
  const auto begin = Clock::now();
  const auto program = play({"--wait", "1"});
  server.accept();
  EXPECT_EQ(program->wait(), 2);
  EXPECT_LT(secondsSince(begin), kBusy);
  EXPECT_THAT(program->output(), HasSubstr("no message from the server"));
}

TEST_F(PlayFaults, SaysAtOnceThatTheReportCannotBeWritten) {
  for (const std::string& place : {folder.file(""), std::string("/proc/none/report.json")}) {
    const auto program = play({"--report", place, "--wait", "20"});
    EXPECT_EQ(program->wait(), 1);
    EXPECT_THAT(program->output(), HasSubstr("--report " + place + ": cannot be written"));
  }
}

TEST_F(PlayFaults, SaysThatTheDiskIsFullWhenItIsAndPlaysOn) {
  const auto program = play({"--record", "/dev/full"});
  server.accept();
  server.receive();
  server.send(standingMessage(1.0));
  EXPECT_THAT(server.receive().value_or(""), StartsWith("(init (unum 3)"));
  EXPECT_TRUE(program->says("/dev/full: recording stops.*No space left")) << program->output();
  server.send(standingMessage(1.02));
  EXPECT_TRUE(server.receive().has_value());
  server.close();
  EXPECT_EQ(program->wait(), 3);
  const std::string output = program->output();
  EXPECT_EQ(output.find("recording stops"), output.rfind("recording stops")) << "said once";
}

// A short trace shows only at its end that there is no room.
TEST_F(PlayFaults, ATraceThatFindsNoRoomIsToldBesideTheLogAndInTheReport) {
  fs::create_symlink("/dev/full", folder.file("3.trace"));
  const auto program = play(
      {"--record", "/dev/full", "--trace", folder.file("3.trace"), "--report", folder.file("report.json")});
  server.accept();
  server.receive();
  server.send(standingMessage(1.0));
  EXPECT_TRUE(server.receive().has_value());
  server.close();
  EXPECT_EQ(program->wait(), 3);
  std::ifstream file(folder.file("report.json"));
  const std::string report{std::istreambuf_iterator<char>(file), {}};
  for (const std::string& words :
       {std::string("/dev/full: recording stops"), folder.file("3.trace") + ": recording stops"}) {
    EXPECT_THAT(program->output(), HasSubstr("nonet play: " + words));
    EXPECT_THAT(report, HasSubstr(words));
  }
}

// start.sh writes what an agent says and its log onto the same disk.
TEST_F(PlayFaults, PlaysOnWhenItsWordsFindNoRoomEither) {
  Program program({"play", "--port", std::to_string(server.port()), "--unum", "3", "--team", "Test",
                   "--record", "/dev/full"},
                  "/dev/full");
  server.accept();
  server.receive();
  for (int i = 0; i < 3; ++i) {
    server.send(standingMessage(1.0 + 0.02 * i));
    EXPECT_TRUE(server.receive().has_value()) << i;
  }
  server.close();
  EXPECT_EQ(program.wait(), 3);
}

/// Reads on until the robot introduces itself, and takes it into the team.
void takeIn(FakeServer& server) {
  EXPECT_THAT(server.receive().value_or(""), StartsWith("(scene"));
  server.send(standingMessage(1.0));
  std::optional<std::string> answer = server.receive();
  while (answer && answer->starts_with("(syn)")) answer = server.receive();
  EXPECT_THAT(answer.value_or(""), StartsWith("(init (unum 3)"));
  server.send(standingMessage(1.02, "(unum 3) (team left) "));
  EXPECT_TRUE(server.receive().has_value());
}

// As servers do that have not loaded all yet, and others when a team may not come in yet.
TEST_F(PlayFaults, AConnectionThatClosesBeforeItsFirstMessageIsTriedAgain) {
  const auto program = play({"--wait", "20"});
  for (const bool reset : {true, false}) {
    server.accept();
    if (!reset) server.receive();  // what has not been read makes the end a reset
    server.close();
  }
  server.accept();
  takeIn(server);
  server.close();
  EXPECT_EQ(program->wait(), 3) << "it has spoken";
  EXPECT_THAT(program->output(), HasSubstr("without a message"));
}

TEST_F(PlayFaults, ButNoLongerThanToldTo) {
  const auto program = play({"--wait", "1", "--reconnect"});
  const auto begin = Clock::now();
  while (program->running() && secondsSince(begin) < kBusy) {
    if (!server.waits(0.1)) continue;
    server.accept();
    server.close();
  }
  EXPECT_FALSE(program->running());
  EXPECT_THAT(program->output(), HasSubstr("no server at 127.0.0.1"));
}

TEST_F(PlayFaults, WaitsForItsTurnWhateverTheServerIsCalled) {
  const auto first = play({});
  server.accept();
  EXPECT_THAT(server.receive().value_or(""), StartsWith("(scene"));
  Program second({"play", "--host", "localhost", "--port", std::to_string(server.port()), "--unum", "4"},
                 folder.file("second.txt"));
  EXPECT_FALSE(server.waits(1.5)) << "it comes before its turn";
  server.send(standingMessage(1.0));
  server.receive();
  server.send(standingMessage(1.02, "(unum 3) (team left) "));
  EXPECT_TRUE(server.waits(kBusy));
}

// A cut connection, half a message, nonsense instead of one: each time the robot introduces itself anew, and
// each of its lives has a log that can be replayed.
TEST_F(PlayFaults, ComesBackIfToldTo) {
  const auto program = play({"--reconnect", "--wait", "5", "--record", folder.file("log.zst")});
  for (const std::string& lastBytes :
       {std::string(), std::string("\0\0\1\0(time (now", 14), std::string("\xff\xff\xff\xff", 4)}) {
    server.accept();
    takeIn(server);
    server.sendRaw(lastBytes);
    server.close();
  }
  server.accept();
  takeIn(server);
  ::kill(program->pid(), SIGTERM);
  EXPECT_EQ(program->wait(), 0);
  EXPECT_THAT(program->output(), HasSubstr("8 messages, 8 answered")) << "all connections together";
  for (const std::string name : {"log.zst", "log.2.zst", "log.3.zst", "log.4.zst"}) {
    Program replay({"replay", folder.file(name)}, folder.file("replay.txt"));
    EXPECT_EQ(replay.wait(), 0) << name << replay.output();
  }
}

TEST_F(PlayFaults, LooksForALostServerAsLongAsToldAndWithoutBeingToldNotAtAll) {
  for (const bool reconnect : {false, true}) {
    auto own = std::make_unique<FakeServer>();
    std::vector<std::string> arguments = {"play",   "--port", std::to_string(own->port()), "--unum", "3",
                                          "--wait", "1"};
    if (reconnect) arguments.emplace_back("--reconnect");
    Program program(arguments, folder.file("lost.txt"));
    own->accept();
    takeIn(*own);
    own.reset();
    const auto begin = Clock::now();
    EXPECT_EQ(program.wait(), reconnect ? 2 : 3) << program.output();
    if (reconnect) {
      EXPECT_GT(secondsSince(begin), 0.9);
      EXPECT_LT(secondsSince(begin), kBusy);
    }
  }
}

// A server that closes every connection at once is not besieged for ever.
TEST_F(PlayFaults, GivesUpOnAServerThatDoesNotTakeItBack) {
  const auto program = play({"--reconnect", "--wait", "1"});
  server.accept();
  takeIn(server);
  server.close();
  const auto begin = Clock::now();
  while (program->running() && secondsSince(begin) < kBusy) {
    if (server.waits(0.2)) {
      server.accept();
      server.close();
    }
  }
  EXPECT_FALSE(program->running());
  EXPECT_THAT(program->output(), HasSubstr("is gone"));
}

TEST_F(PlayFaults, PlaysOnWithoutALogIfTheNextOneCannotBeWritten) {
  const std::string logs = folder.file("logs");
  fs::create_directories(logs);
  const auto program = play({"--reconnect", "--record", logs + "/a.zst"});
  server.accept();
  takeIn(server);
  fs::remove_all(logs);
  server.close();
  server.accept();
  takeIn(server);
  EXPECT_TRUE(program->says("a.2.zst: .*it goes on without a log"));
  server.close();
}

TEST(CommandLine, WrongOptionsEndWithOne) {
  const TestFolder folder("nonet_options");
  for (const std::vector<std::string>& wrong : {std::vector<std::string>{"play", "--port", "99999"},
                                                {"play", "--nosuch"},
                                                {"match", "--seed", "x"},
                                                {"nosuchcommand"},
                                                {}}) {
    Program program(wrong, folder.file("options.txt"));
    EXPECT_EQ(program.wait(), 1) << program.output();
  }
  Program help({"--help"}, folder.file("help.txt"));
  EXPECT_EQ(help.wait(), 0);
}

// Each of these once did something else than it says, without a word.
TEST(CommandLine, WhatCannotBeMeantIsRefused) {
  const TestFolder folder("nonet_refused");
  const std::vector<std::pair<std::vector<std::string>, std::string>> wrong = {
      {{"match", "--minutes", "nan"}, "no finite number"},
      {{"match", "--kick-off-wait", "-5"}, "not in range"},
      {{"match", "--set", "RuleHalfTime=1"}, "--minutes"},
      {{"match", "--set", "Foo=10"}, "unknown setting 'Foo'"},
      {{"fidelity", NONET_TEST_DATA "/physics", "--svg", folder.file("said.txt")},
       "said.txt is a file: name a folder"},
      {{"soak", "--out", folder.file("said.txt/below")}, "said.txt is a file: name a folder"},
      {{"match", "--seed", "-1"}, "no whole number"},
      {{"match", "--port", "-3"}, "0 to 65535"},
      {{"match", "--port", "80000"}, "0 to 65535"},
      {{"serve", "--monitor-port", "80000"}, "0 to 65535"},
      {{"view", "localhost:99999"}, "1 to 65535"},
      {{"match", "--alone", "--right-set", "team.ball.kick=false"}, "--alone"},
      {{"match", "--alone", "--right", "Them"}, "--alone"},
      {{"play", "--draw-host", "localhost"}, "--draw"},
      {{"play", "--wait", "0"}, "--wait: must be more than 0"},
      {{"serve", "--answer-timeout", "0"}, "--answer-timeout: must be more than 0"},
      {{"soak", "--effectors", "-1"}, "--effectors: must be more than 0"},
      {{"series", "own", "wall", "--kick-off-wait", "1e300"}, "not in range"},
      {{"rise-report", "--threads", "-3"}, "not in range"},
      {{"env", "run", "--threads", "99999999"}, "not in range"},
      {{"skill", "play", "kick_quick", "--ball", "1e308,0"}, "not in range"},
      {{"kick-report", "--kick", "kick_power", "--stop"}, "--kick any"},
      {{"ball-report", "--skill", "run", "--opponent-data", NONET_SOURCE_DIR},
       "only duel, attack, siege, scrum, loose have opponents"},
      {{"play", "--wait", "nan"}, "no finite number"},
      {{"play", "--start=nan,1"}, "finite"},
      {{"soak", "--effectors", "nan"}, "no finite number"},
      {{"series", "own", "own", "--server-command", "x"}, "--where"},
      {{"series", "own", "own", "--where", "localhost:1:2:3"}, "HOST:PORT:MONITORPORT"},
      {{"ball-report", "--skill", "run", "--svg", "x_"}, "slalom"},
      {{"replay", "--set", "no.such=1", std::string(NONET_TEST_DATA) + "/replay/crowd.log.gz"}, "no.such"},
      {{"skill", "check", folder.file("")}, "no *.skl"},
      {{"--nosuch"}, "'--nosuch'"}};
  for (const auto& [arguments, words] : wrong) {
    Program program(arguments, folder.file("said.txt"));
    EXPECT_EQ(program.wait(), 1) << arguments.back();
    EXPECT_THAT(program.output(), HasSubstr(words));
  }
}

// A file of parameters is one word: what stands behind it is not another file.
TEST(CommandLine, WhatStandsBehindParametersIsNoFile) {
  const TestFolder folder("nonet_behind_params");
  const std::string file = folder.file("mine.toml");
  std::ofstream(file) << "[team.ball]\nkick = false\n";
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{"env", "--params", file, "fly"}, "unknown environment 'fly'"},
      {{"optimize", "--out", folder.file("run"), "--params", file, "fly"}, "unknown task 'fly'"},
      {{"optimize", "--out", folder.file("run"), "--keys", "team.", "fly"}, "unknown task 'fly'"},
      {{"replay", "--params", file, folder.file("none.zst")}, "none.zst"}};
  for (const auto& [arguments, words] : cases) {
    Program program(arguments, folder.file("said.txt"));
    EXPECT_NE(program.wait(), 0) << arguments[0];
    EXPECT_THAT(program.output(), HasSubstr(words));
    EXPECT_THAT(program.output(), testing::Not(HasSubstr("--params"))) << arguments[0];
  }
}

// What is short waits in a buffer until the program ends.
TEST(CommandLine, OutputThatFindsNoRoomIsTold) {
  const TestFolder folder("nonet_full_output");
  for (const std::string arguments : {"env --list", "--help"}) {
    Program program("/bin/sh", {"-c", NONET_BINARY " " + arguments + " >/dev/full"}, folder.file("said.txt"));
    EXPECT_EQ(program.wait(), 1) << arguments;
    EXPECT_THAT(program.output(), HasSubstr("nonet: the standard output is not complete")) << arguments;
  }
}

TEST(CommandLine, ATornBatchOfActionsIsTold) {
  const TestFolder folder("nonet_torn_batch");
  Program program("/bin/sh", {"-c", "echo hello | " NONET_BINARY " env run >/dev/null"},
                  folder.file("said.txt"));
  EXPECT_EQ(program.wait(), 1);
  EXPECT_THAT(program.output(), HasSubstr("ended within a batch of actions, after 6 of its"));
}

TEST(CommandLine, AMisspelledCommandGetsAHint) {
  const TestFolder folder("nonet_hint");
  Program program({"mach", "--minutes", "1"}, folder.file("hint.txt"));
  EXPECT_EQ(program.wait(), 1);
  EXPECT_THAT(program.output(), HasSubstr("there is no command 'mach': did you mean 'match'?"));
}

TEST(CommandLine, EveryCommandIsInTheReadme) {
  const TestFolder folder("nonet_commands");
  Program help({"--help"}, folder.file("help.txt"));
  EXPECT_EQ(help.wait(), 0);
  std::ifstream file(NONET_SOURCE_DIR "/README.md");
  const std::string readme{std::istreambuf_iterator<char>(file), {}};
  const std::string text = help.output();
  const std::string list = text.substr(text.find("Subcommands:"));
  const std::regex name("\n  ([a-z-]+) ");
  int commands = 0;
  for (std::sregex_iterator command(list.begin(), list.end(), name), end; command != end;
       ++command, ++commands) {
    EXPECT_THAT(readme, HasSubstr("`nonet " + (*command)[1].str() + "`"));
  }
  EXPECT_GE(commands, 12);
}

}  // namespace
}  // namespace nonet::app
