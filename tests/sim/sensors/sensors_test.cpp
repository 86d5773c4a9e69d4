// Sense messages of the simulation against those of the real server, byte by byte (its vision noise switched
// off).
#include "nonet/sim/sensors/sensors.h"

#include <filesystem>

#include <gtest/gtest.h>

#include "nonet/protocol/percept_text.h"

#include "sim/fidelity/replay_server.h"

namespace nonet::sim {
namespace {

struct MessageLog {
  const char* file;
  const char* history;  // of which experiment's start it is; empty: standing
};

class SenseMessages : public testing::TestWithParam<MessageLog> {};

Recording readLog(const char* name) {
  return readRecording(std::filesystem::path(NONET_TEST_DATA) / "sense" / (std::string(name) + ".jsonl.gz"));
}

ReplayServer::Answer answerOf(const RecordedCycle& cycle) {
  ReplayServer::Answer answer;
  answer.speeds.push_back(cycle.robots[0].speeds);
  answer.trainer = cycle.trainer;
  return answer;
}

TEST_P(SenseMessages, AreTheSameBytes) {
  const Recording recording = readLog(GetParam().file);
  ReplayServer server({}, recording.robotType, 1);
  const std::string history = GetParam().history;
  ASSERT_TRUE(history.empty() ? replayStanding(recording.cycles[0], server) : replayHistory(history, server));
  const VisionField field;
  const std::vector<VisiblePlayer> players{VisiblePlayer{server.robot(0), protocol::TeamName("Probe"), 1}};
  SensorContext context;
  context.field = &field;
  context.players = players;
  context.side = protocol::TeamSide::Left;
  context.noise = false;
  context.truePosition = context.trueHeading = context.trueBallPosition = true;
  Random random(1);
  AgentSensors sensors(random);
  protocol::Percept recorded;
  protocol::Percept ours;
  std::string text;
  int compared = 0;
  int withVision = 0;
  for (const RecordedCycle& cycle : recording.cycles) {
    if (!cycle.message.empty()) {
      protocol::parsePercept(cycle.message, recorded);
      ours.clear();
      ours.time = recorded.time;
      ours.game = recorded.game;
      ours.order = {{protocol::PerceptKind::Time, 0}, {protocol::PerceptKind::GameState, 0}};
      context.vision = recorded.vision.has_value();
      sensors.fill(server.world(), server.robot(0), context, random, ours);
      text.clear();
      protocol::writePercept(ours, text);
      EXPECT_EQ(text, cycle.message) << "message " << compared;
      ++compared;
      withVision += context.vision;
      if (testing::Test::HasFailure() && compared > 200) return;
    }
    server.step(answerOf(cycle));
  }
  EXPECT_GT(compared, 100);
  EXPECT_GT(withVision, 30);
}

INSTANTIATE_TEST_SUITE_P(Recorded, SenseMessages,
                         testing::Values(MessageLog{"look_type0", "settle_move"},
                                         MessageLog{"look_type3", "settle_move"},
                                         MessageLog{"fall_type4", ""},
                                         MessageLog{"walk_type1", "walk_until_fall"}),
                         [](const auto& info) { return std::string(info.param.file); });

}  // namespace
}  // namespace nonet::sim
