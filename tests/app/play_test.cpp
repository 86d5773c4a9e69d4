#include <csignal>
#include <cstdio>
#include <filesystem>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "nonet/agent/agent_setup.h"
#include "nonet/app/play_client.h"
#include "nonet/lab/reports/replay.h"
#include "nonet/protocol/log_file.h"

#include "app/fake_server.h"

namespace nonet::app {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr const char* kAccepted = "(unum 3) (team left) ";

PlaySettings settingsFor(const auto& server) {
  PlaySettings settings;
  settings.port = server.port();
  settings.wait = 1.0;
  settings.quiet = true;
  agent::AgentChoice choice;
  choice.unum = 3;
  choice.team = "Test";
  choice.robotType = 2;
  settings.session.agent = agent::makeAgentSettings(choice, NONET_SOURCE_DIR);
  return settings;
}

std::string temporaryFile(const std::string& name) {
  return (std::filesystem::temp_directory_path() / (name + std::to_string(::getpid()))).string();
}

/// Runs play() beside the test and gives its exit code.
class Player {
 public:
  explicit Player(const PlaySettings& settings) : thread_([this, settings] { exit_ = play(settings); }) {}
  ~Player() {
    if (thread_.joinable()) thread_.join();
  }
  PlayExit wait() {
    thread_.join();
    return exit_;
  }

 private:
  PlayExit exit_ = PlayExit::Error;
  std::thread thread_;
};

int countOf(const std::string& text, const std::string& part) {
  int count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(Play, GivesUpWithoutServer) {
  const ClosedPort nobody;
  PlaySettings settings = settingsFor(nobody);
  settings.wait = 0.5;
  EXPECT_EQ(play(settings), PlayExit::NoServer);
}

TEST(Play, WaitsForALateServer) {
  ClosedPort late;
  PlaySettings settings = settingsFor(late);
  settings.wait = 20.0;
  Player player(settings);
  std::this_thread::sleep_for(std::chrono::milliseconds(400));
  late.acceptAndClose();
  EXPECT_EQ(player.wait(), PlayExit::ServerGone);
}

TEST(Play, IntroducesItselfAndAnswersEachMessageOnce) {
  FakeServer server;
  Player player(settingsFor(server));
  server.accept();
  EXPECT_EQ(server.receive(), "(scene rsg/agent/nao/nao_hetero.rsg 2)(syn)");
  server.send(standingMessage(1.0));
  const std::string second = server.receive().value_or("");
  EXPECT_THAT(second, StartsWith("(init (unum 3)(teamname Test))"));
  EXPECT_EQ(countOf(second, "(syn)"), 1);
  for (int i = 1; i <= 5; ++i) {
    server.send(standingMessage(1.0 + 0.02 * i, i == 2 ? kAccepted : ""));
    const std::string answer = server.receive().value_or("");
    EXPECT_THAT(answer, EndsWith("(syn)"));
    EXPECT_EQ(countOf(answer, "(syn)"), 1);
    EXPECT_THAT(answer, HasSubstr("(rle3 "));
    EXPECT_THAT(answer, Not(HasSubstr("init")));
  }
  EXPECT_EQ(server.receive(0.2), std::nullopt) << "never two answers for one message";
  server.close();
  EXPECT_EQ(player.wait(), PlayExit::ServerGone);
}

TEST(Play, SendsNoSynIfToldSo) {
  FakeServer server;
  PlaySettings settings = settingsFor(server);
  settings.session.sync = false;
  settings.rescue = false;
  settings.wait = 5.0;
  Player player(settings);
  server.accept();
  EXPECT_EQ(server.receive(), "(scene rsg/agent/nao/nao_hetero.rsg 2)");
  EXPECT_EQ(server.receive(1.8), std::nullopt);
  server.send(standingMessage(1.0));
  EXPECT_THAT(server.receive().value_or(""), Not(HasSubstr("syn")));
  server.close();
  player.wait();
}

TEST(Play, FreesAHangingServer) {
  FakeServer server;
  PlaySettings settings = settingsFor(server);
  settings.wait = 30.0;
  Player player(settings);
  server.accept();
  EXPECT_THAT(server.receive().value_or(""), StartsWith("(scene"));
  int syns = 0;
  while (const auto text = server.receive()) {
    EXPECT_EQ(*text, "(syn)");
    ++syns;
  }
  EXPECT_GT(syns, 5);  // then it closed, to connect anew
  server.accept();
  EXPECT_THAT(server.receive().value_or(""), StartsWith("(scene"));
  server.send(standingMessage(1.0));
  EXPECT_THAT(server.receive().value_or(""), StartsWith("(init"));
  EXPECT_EQ(server.receive(2.0), std::nullopt) << "after a message it never syncs on its own";
  server.close();
  EXPECT_EQ(player.wait(), PlayExit::ServerGone);
}

TEST(Play, TellsARefusal) {
  FakeServer server;
  Player player(settingsFor(server));
  server.accept();
  server.receive();
  server.send(standingMessage(1.0));
  std::optional<std::string> answer = server.receive();
  while (answer && !answer->starts_with("(init")) answer = server.receive();
  ASSERT_TRUE(answer) << "it introduces itself";
  for (int i = 1; i <= agent::Session::kRefusalPatience + 1; ++i) {
    server.send(standingMessage(1.0 + 0.02 * i));
    server.receive(0.5);
  }
  EXPECT_EQ(player.wait(), PlayExit::Refused);
}

TEST(Play, GivesUpOnASillyLength) {
  FakeServer server;
  Player player(settingsFor(server));
  server.accept();
  server.receive();
  server.sendRaw("\x7f\xff\xff\xff garbage");
  EXPECT_EQ(player.wait(), PlayExit::Error);
}

TEST(Play, SurvivesGarbageInMessages) {
  FakeServer server;
  Player player(settingsFor(server));
  server.accept();
  server.receive();
  server.send(standingMessage(1.0));
  server.receive();
  server.send("((((\"");
  EXPECT_TRUE(server.receive().has_value());
  server.send(std::string("\0\xff)(now x)", 10));
  EXPECT_TRUE(server.receive().has_value());
  server.close();
  EXPECT_EQ(player.wait(), PlayExit::ServerGone);
}

TEST(Play, AnswersOnlyTheNewestAndReplaysTheSame) {
  const std::string log = temporaryFile("nonet_play_newest");
  FakeServer server;
  PlaySettings settings = settingsFor(server);
  settings.record = log;
  settings.recordHeader = agent::logHeader(settings.session.agent, "test");
  Player player(settings);
  server.accept();
  server.receive();
  server.send(standingMessage(1.0));
  server.receive();
  // Six messages in one piece, the last one cut in two: five are absorbed with one answer.
  std::string bytes;
  for (int i = 1; i <= 6; ++i)
    protocol::appendFrame(bytes, standingMessage(1.0 + 0.02 * i, i == 1 ? kAccepted : ""));
  server.sendRaw(bytes.substr(0, bytes.size() - 30));
  EXPECT_TRUE(server.receive().has_value());
  EXPECT_EQ(server.receive(0.2), std::nullopt);
  server.sendRaw(bytes.substr(bytes.size() - 30));
  EXPECT_TRUE(server.receive().has_value());
  server.close();
  EXPECT_EQ(player.wait(), PlayExit::ServerGone);

  lab::ReplaySettings replaySettings;
  replaySettings.dataFolder = NONET_SOURCE_DIR;
  const lab::ReplayReport report = lab::replay(log, replaySettings);
  EXPECT_EQ(report.counts.messages, 7);
  EXPECT_EQ(report.counts.passedOver, 4);
  EXPECT_EQ(report.effectorDifferences, 0);
  EXPECT_EQ(report.problem, "");
  std::filesystem::remove(log);
}

TEST(Play, EndsCleanlyOnSigterm) {
  const std::string log = temporaryFile("nonet_play_sigterm");
  FakeServer server;
  PlaySettings settings = settingsFor(server);
  settings.record = log;
  settings.recordHeader = agent::logHeader(settings.session.agent, "test");
  Player player(settings);
  server.accept();
  server.receive();
  server.send(standingMessage(1.0));
  server.receive();
  std::raise(SIGTERM);
  EXPECT_EQ(player.wait(), PlayExit::Stopped);
  protocol::LogReader reader(log);
  protocol::LogLine line;
  int lines = 0;
  while (reader.next(line)) ++lines;
  EXPECT_EQ(reader.end(), protocol::LogReader::End::Whole);
  EXPECT_EQ(lines, 4);  // header, scene, message, init
  std::filesystem::remove(log);
}

}  // namespace
}  // namespace nonet::app
