#include "nonet/lab/reports/replay.h"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <unistd.h>

#include "nonet/agent/agent_setup.h"
#include "nonet/protocol/log_file.h"

namespace nonet::lab {
namespace {

const std::string kData = NONET_TEST_DATA "/replay/";

ReplaySettings settings() {
  ReplaySettings settings;
  settings.dataFolder = NONET_SOURCE_DIR;
  return settings;
}

class Folder {
 public:
  Folder() : path_(std::filesystem::temp_directory_path() / ("nonet_replay_" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

/// What the messages of a recording make our agent do, written as a log of ours.
void record(const std::string& from, const std::string& to, const agent::AgentSettings& agentSettings,
            int dropEvery = 0, bool sync = true) {
  protocol::LogReader reader(from);
  protocol::LogWriter writer(to, agent::logHeader(agentSettings, "test", sync));
  if (agentSettings.startPose) writer.comment(agent::startComment(*agentSettings.startPose));
  agent::Session session({agentSettings, sync});
  writer.sent(session.begin());
  protocol::LogLine line;
  int count = 0;
  while (reader.next(line)) {
    if (line.kind != protocol::LogLine::Kind::Received) continue;
    writer.received(line.text);
    session.receive(line.text);
    if (dropEvery == 0 || ++count % dropEvery != 0) writer.sent(session.answer());
  }
}

agent::AgentSettings someAgent() {
  agent::AgentChoice choice;
  choice.unum = 7;
  choice.team = "Blue";
  choice.robotType = 3;
  choice.seed = 77;
  return agent::makeAgentSettings(choice, NONET_SOURCE_DIR);
}

TEST(Replay, RecordingsOfTheServerAreUnderstoodCompletely) {
  for (const std::string name : {"match_start.log.gz", "crowd.log.gz"}) {
    const ReplayReport report = replay(kData + name, settings());
    EXPECT_FALSE(report.own);
    EXPECT_EQ(report.counts.unknownTokens, 0) << name;
    EXPECT_EQ(report.roundtripDifferences, 0) << name;
    EXPECT_EQ(report.counts.lostCycles, 0) << name;
    EXPECT_EQ(report.counts.messages, name[0] == 'm' ? 400 : 150);
    EXPECT_EQ(report.perceptors.at("time"), report.counts.messages);
    EXPECT_EQ(report.perceptors.at("See"), name[0] == 'm' ? 134 : 50);
    EXPECT_TRUE(report.clean());
    ASSERT_TRUE(report.positionError.has_value());
    EXPECT_EQ(report.positionError->count, static_cast<std::size_t>(report.perceptors.at("See")));
    EXPECT_TRUE(report.toJson()["effector_differences"].is_null());
  }
}

TEST(Replay, FindsOutWhoRecordedAForeignLog) {
  const agent::AgentSettings fromHandshake = agentOfLog(kData + "match_start.log.gz", settings());
  EXPECT_EQ(fromHandshake.unum, 7);
  EXPECT_EQ(fromHandshake.team, "Blue");
  EXPECT_EQ(fromHandshake.robotType, 3);
  const agent::AgentSettings fromArms = agentOfLog(kData + "crowd.log.gz", settings());
  EXPECT_EQ(fromArms.unum, 1);
  EXPECT_EQ(fromArms.team, "Probe");
}

TEST(Replay, OwnLogsComeOutByteForByte) {
  const Folder folder;
  agent::AgentSettings agentSettings = someAgent();
  agentSettings.startPose = Pose2(-3.25, 1.5, 0.1);
  record(kData + "match_start.log.gz", folder.file("own.zst"), agentSettings);
  const ReplayReport report = replay(folder.file("own.zst"), settings());
  EXPECT_TRUE(report.own);
  EXPECT_EQ(report.counts.messages, 400);
  EXPECT_EQ(report.effectorDifferences, 0);
  EXPECT_EQ(report.toJson()["effector_differences"], 0);
  EXPECT_FALSE(report.firstDifference.has_value());
}

TEST(Replay, PassedOverMessagesAreReplayedAsSuch) {
  const Folder folder;
  record(kData + "match_start.log.gz", folder.file("late.zst"), someAgent(), 7);
  const ReplayReport report = replay(folder.file("late.zst"), settings());
  EXPECT_EQ(report.effectorDifferences, 0);
  EXPECT_EQ(report.counts.passedOver, 400 / 7);
}

TEST(Replay, AgentsThatSendNoSynReplayToo) {
  const Folder folder;
  record(kData + "match_start.log.gz", folder.file("own.zst"), someAgent(), 0, false);
  const ReplayReport report = replay(folder.file("own.zst"), settings());
  EXPECT_GT(report.counts.answers, 300);
  EXPECT_EQ(report.effectorDifferences, 0);
  EXPECT_EQ(agent::logHeader(someAgent(), "test").options.count("sync"), 0U) << "as in older logs";
}

TEST(Replay, NamesTheFirstDifference) {
  const Folder folder;
  record(kData + "match_start.log.gz", folder.file("own.zst"), someAgent());
  // The same log with one answer changed, plain text.
  protocol::LogReader reader(folder.file("own.zst"));
  std::ofstream changed(folder.file("changed.log"));
  protocol::LogLine line;
  int answers = 0;
  std::size_t changedLine = 0;
  while (reader.next(line)) {
    const char* marks = "<>=# ";
    std::string text(line.text);
    if (line.kind == protocol::LogLine::Kind::Sent && ++answers == 100) {
      text.insert(text.size() - 5, "(he1 0.123)");
      changedLine = line.number;
    }
    changed << marks[static_cast<int>(line.kind)] << ' ' << text << '\n';
  }
  changed.close();
  const ReplayReport report = replay(folder.file("changed.log"), settings());
  EXPECT_EQ(report.effectorDifferences, 1);
  ASSERT_TRUE(report.firstDifference.has_value());
  EXPECT_EQ(report.firstDifference->line, changedLine);
  EXPECT_NE(report.firstDifference->recorded.find("(he1 0.123)"), std::string::npos);
  EXPECT_FALSE(report.clean());
}

TEST(Replay, TornLogsAreReplayedAsFarAsTheyGo) {
  const Folder folder;
  record(kData + "match_start.log.gz", folder.file("own.zst"), someAgent());
  const auto size = std::filesystem::file_size(folder.file("own.zst"));
  std::filesystem::resize_file(folder.file("own.zst"), size * 2 / 3);
  const ReplayReport report = replay(folder.file("own.zst"), settings());
  EXPECT_NE(report.problem, "");
  EXPECT_GT(report.counts.messages, 100);
  EXPECT_LT(report.counts.messages, 400);
  EXPECT_EQ(report.effectorDifferences, 0);
}

TEST(Replay, JsonHasThePromisedKeys) {
  const nlohmann::ordered_json json = replay(kData + "crowd.log.gz", settings()).toJson();
  for (const char* key :
       {"file", "messages", "unknown", "roundtrip_differences", "lost_cycles", "effector_differences"}) {
    EXPECT_TRUE(json.contains(key)) << key;
  }
  EXPECT_GT(json["cycle_us"]["median"], 0.0);
  EXPECT_GE(json["cycle_us"]["p999"], json["cycle_us"]["median"]);
}

TEST(Replay, MissingFilesAreNamed) {
  try {
    replay("/nowhere/at.all", settings());
    FAIL();
  } catch (const protocol::LogError& error) {
    EXPECT_NE(std::string(error.what()).find("/nowhere/at.all"), std::string::npos);
  }
}

}  // namespace
}  // namespace nonet::lab
