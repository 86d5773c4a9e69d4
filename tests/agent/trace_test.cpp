#include "nonet/agent/trace.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "nonet/protocol/percept_text.h"

namespace nonet::agent {
namespace {

TEST(Trace, SaysWhatTheAgentBelievesInAllThreeForms) {
  AgentSettings settings;
  settings.unum = 5;
  settings.team = "Reds";
  settings.skillFolder = std::string(NONET_SOURCE_DIR) + "/skills";
  Agent agent(settings);
  protocol::Percept percept;
  protocol::parsePercept(
      "(time (now 7.50))(GS (unum 5) (team right) (sl 0) (sr 0) (t 3.25) (pm PlayOn))(GYR (n torso) (rt 0.00 "
      "0.00 "
      "0.00))(ACC (n torso) (a 0.00 0.00 9.81))",
      percept);
  agent.step(percept);
  const nlohmann::ordered_json trace = traceOf(agent);
  EXPECT_EQ(trace["unum"], 5);
  EXPECT_EQ(trace["game_time"], 3.25);
  EXPECT_EQ(trace["phase"], "play on");
  EXPECT_EQ(trace["side"], -1) << "the right team's own goal lies at +x";
  EXPECT_FALSE(trace["left"]);
  EXPECT_TRUE(trace["ball"].is_null()) << "nothing was seen";
  const Pose2& pose = agent.world().self.X_FR;
  EXPECT_NEAR(trace["pose"][0].get<double>(), pose.translation.x(), 1e-3);
  EXPECT_NEAR(trace["pose"][2].get<double>(), toDegrees(pose.rotation), 0.01);
  EXPECT_NEAR(trace["covariance"][0].get<double>(), agent.world().self.covariance(0, 0), 1e-6);
  ASSERT_EQ(trace["particles"].size(), agent.particles().size());
  EXPECT_GT(trace["particles"].size(), 100U) << "lost: everywhere";
  for (std::size_t i = 0; i < trace["particles"].size(); ++i)
    EXPECT_NEAR(trace["particles"][i][0].get<double>(), agent.particles()[i].translation.x(), 0.006);

  const std::string line = traceCsv(trace);
  const std::string_view header = traceCsvHeader();
  EXPECT_EQ(std::count(line.begin(), line.end(), ','), std::count(header.begin(), header.end(), ','));
  EXPECT_THAT(line, ::testing::StartsWith("7.5,3.25,5,play on,"));
  const std::string text = traceText(trace);
  EXPECT_THAT(text, ::testing::HasSubstr("Reds 5 at 3.25 s of the game"));
  EXPECT_THAT(text, ::testing::HasSubstr("ball      not known"));
  EXPECT_THAT(text, ::testing::HasSubstr("particles 240, nine tenths within"));
}

}  // namespace
}  // namespace nonet::agent
