// Keepaway and penalty shoot-out: server facts 4.11.
#include <gtest/gtest.h>

#include "sim/scenario.h"

namespace nonet::sim::test {
namespace {

TEST(Keepaway, EndsWhenTheBallLeavesTheShrinkingBox) {
  Settings settings = quietSettings();
  settings.keepaway = true;
  Scenario s(settings);
  s.add(TeamSide::Left, 2);
  s.setMode(PlayMode::PlayOn);
  s.placeBall(9.0, 0.0);
  s.seconds(0.2);
  EXPECT_EQ(s.mode(), PlayMode::PlayOn);
  s.command("(time 60)");  // the box is 2 m shorter at each end after a minute
  s.step();
  EXPECT_EQ(s.mode(), PlayMode::GameOver);
}

TEST(Keepaway, EndsWhenATakerTouchesTheBall) {
  Settings settings = quietSettings();
  settings.keepaway = true;
  Scenario s(settings);
  const AgentHandle taker = s.add(TeamSide::Right, 2);
  s.setMode(PlayMode::PlayOn);
  s.place(taker, 2.0, 2.0);
  s.step();
  s.touch(taker);
  s.step(2);
  EXPECT_EQ(s.mode(), PlayMode::GameOver);
}

TEST(PenaltyShootout, AGoalkeeperThatLeavesItsAreaGivesAwayAGoal) {
  Settings settings = quietSettings();
  settings.penaltyShootout = true;
  Scenario s(settings);
  const AgentHandle goalie = s.add(TeamSide::Right, 1);
  s.place(goalie, 14.0, 0.0);
  s.step(2);
  s.setMode(PlayMode::PlayOn);
  s.step(3);
  EXPECT_EQ(s.mode(), PlayMode::PlayOn);
  s.place(goalie, 12.0, 0.0);
  s.step(2);
  EXPECT_EQ(s.mode(), PlayMode::GoalLeft);
  EXPECT_EQ(s.sim.match().scoreLeft, 1);
}

// Nobody is punished for a double touch or an indirect goal.
TEST(PenaltyShootout, KickOffRulesAreOff) {
  Settings settings = quietSettings();
  settings.penaltyShootout = true;
  Scenario s(settings);
  const AgentHandle kicker = s.add(TeamSide::Left, 2);
  s.add(TeamSide::Left, 3);
  const AgentHandle goalie = s.add(TeamSide::Right, 1);
  s.place(goalie, 14.0, 0.0);
  s.step(2);
  s.command("(kickOff Left)");
  s.step();
  s.touch(kicker);
  ASSERT_TRUE(s.waitFor(PlayMode::PlayOn, 0.1));
  s.placeBall(0.0, 3.0);
  s.seconds(0.2);
  s.touch(kicker);
  s.step(2);
  EXPECT_EQ(s.mode(), PlayMode::PlayOn);
  s.setMode(PlayMode::FreeKickLeft);
  s.seconds(1.2);
  s.touch(kicker);
  s.step(2);
  ASSERT_EQ(s.mode(), PlayMode::PlayOn);
  s.placeBall(15.05, 0.5);
  s.step();
  EXPECT_EQ(s.mode(), PlayMode::GoalLeft) << "from an indirect kick";
}

}  // namespace
}  // namespace nonet::sim::test
