// Clock, halves and the end: server facts 4.2, one scenario per rule.
#include <gtest/gtest.h>

#include "sim/scenario.h"

namespace nonet::sim::test {
namespace {

TEST(Clock, StandsStillBeforeKickOffAndRunsInAllOtherModes) {
  Scenario s;
  s.add(TeamSide::Left, 1);
  s.seconds(0.5);
  EXPECT_EQ(s.sim.match().time, 0.0F);
  for (int mode = 1; mode < protocol::kPlayModeCount; ++mode) {
    const auto playMode = static_cast<PlayMode>(mode);
    if (playMode == PlayMode::GameOver) continue;
    s.setMode(playMode);
    const float before = s.sim.match().time;
    s.step();
    EXPECT_EQ(s.sim.match().time, before + 0.02F) << protocol::playModeName(playMode);
  }
}

TEST(Clock, StandsStillAfterTheEnd) {
  Scenario s;
  s.add(TeamSide::Left, 1);
  s.setMode(PlayMode::GameOver);
  s.seconds(0.2);
  EXPECT_EQ(s.sim.match().time, 0.0F);
  EXPECT_EQ(s.mode(), PlayMode::GameOver);
}

TEST(Clock, GameTimeIsAFloatSum) {
  Scenario s;
  s.setMode(PlayMode::PlayOn);
  float sum = 0.0F;
  for (int i = 0; i < 365; ++i) {
    s.step();
    sum += 0.02F;
  }
  EXPECT_EQ(s.sim.match().time, sum);
  EXPECT_NE(sum, 7.3F) << "it drifts, as in the server";
}

TEST(Halves, SecondHalfStartsAtHalfTimeWithTheTimeKept) {
  Scenario s(shortHalves(1.0));
  s.add(TeamSide::Left, 1);
  s.setMode(PlayMode::PlayOn);
  ASSERT_TRUE(s.waitFor(PlayMode::BeforeKickOff, 1.1));
  EXPECT_EQ(s.sim.match().half, 2);
  EXPECT_NEAR(s.sim.match().time, 1.0, 0.021);
  const float time = s.sim.match().time;
  s.setMode(PlayMode::PlayOn);
  s.step();
  EXPECT_EQ(s.sim.match().time, time + 0.02F);
  EXPECT_TRUE(s.waitFor(PlayMode::GameOver, 1.1));
  EXPECT_NEAR(s.sim.match().time, 2.0, 0.021);
}

TEST(Halves, SingleHalfTimeEndsTheGame) {
  Settings settings = shortHalves(0.5);
  settings.singleHalfTime = true;
  Scenario s(settings);
  s.setMode(PlayMode::PlayOn);
  EXPECT_TRUE(s.waitFor(PlayMode::GameOver, 0.6));
}

TEST(Halves, ChangeSidesInSecondHalfSwapsTeamsWithNamesAndScores) {
  Settings settings = shortHalves(0.5);
  settings.changeSidesInSecondHalf = true;
  Scenario s(settings);
  const AgentHandle left = s.add(TeamSide::Left, 1);
  const AgentHandle right = s.add(TeamSide::Right, 2);
  s.place(left, -5.0, 1.0);
  s.place(right, 5.0, 1.0);
  s.command("(score (left 3)(right 1))");
  const auto scene = s.sim.sceneVersion();
  s.setMode(PlayMode::PlayOn);
  ASSERT_TRUE(s.waitFor(PlayMode::BeforeKickOff, 0.6));
  EXPECT_EQ(s.sim.match().teamLeft, "R");
  EXPECT_EQ(s.sim.match().teamRight, "L");
  EXPECT_EQ(s.sim.match().scoreLeft, 1);
  EXPECT_EQ(s.sim.match().scoreRight, 3);
  EXPECT_EQ(s.info(left).side, TeamSide::Right);
  EXPECT_NE(s.sim.sceneVersion(), scene) << "monitors get the new names";
  s.step(2);
  // Robots kept their place, are now in the wrong half and get cleared.
  EXPECT_NEAR(s.torso(left).x(), 2.5, 0.1);
  EXPECT_NEAR(s.torso(right).x(), -2.5, 0.1);
  s.setMode(PlayMode::GoalLeft);
  protocol::Effectors beam;
  beam.beam = Pose2(-7.0, 2.0, 0.0);
  s.sim.act(left, beam);
  s.step();
  EXPECT_NEAR(s.torso(left).x(), 7.0, 0.01) << "beams are turned without a word";
}

TEST(Halves, ScoresOfTheTrainerStayWithTheTeamsAfterTheChange) {
  Settings settings = shortHalves(0.1);
  settings.changeSidesInSecondHalf = true;
  Scenario s(settings);
  s.add(TeamSide::Left, 1);
  s.setMode(PlayMode::PlayOn);
  ASSERT_TRUE(s.waitFor(PlayMode::BeforeKickOff, 0.2));
  s.command("(score (left 4)(right 0))");
  EXPECT_EQ(s.sim.match().scoreRight, 4);
}

// The clock comes first in a cycle, so the half is over when the rules look at the ball.
TEST(Halves, AGoalAtTheSameMomentDoesNotCount) {
  const auto untilTheEnd = [](Scenario& s) {
    s.add(TeamSide::Left, 1);
    s.setMode(PlayMode::PlayOn);
    s.placeBall(5.0, 0.0);
  };
  Scenario whole(shortHalves(0.5));
  untilTheEnd(whole);
  int cycles = 0;
  for (; whole.mode() == PlayMode::PlayOn && cycles < 100; ++cycles) whole.step();
  ASSERT_EQ(whole.mode(), PlayMode::BeforeKickOff);
  for (const int before : {1, 2}) {
    Scenario s(shortHalves(0.5));
    untilTheEnd(s);
    s.step(cycles - before);
    s.placeBall(15.1, 0.0);
    s.step();
    EXPECT_EQ(s.mode(), before == 1 ? PlayMode::BeforeKickOff : PlayMode::GoalLeft);
    EXPECT_EQ(s.sim.match().scoreLeft, before - 1);
  }
}

TEST(GameOver, NothingHappensAnyMore) {
  Settings settings = quietSettings();
  settings.automaticQuit = true;
  Scenario s(settings);
  const AgentHandle player = s.add(TeamSide::Left, 2);
  s.setMode(PlayMode::GameOver);
  s.touch(player);
  s.step();
  s.placeBall(15.05, 0.0, 0.042);
  s.seconds(12.0);
  EXPECT_EQ(s.mode(), PlayMode::GameOver);
  EXPECT_EQ(s.sim.match().scoreLeft, 0);
}

TEST(GameOver, TheFoulRulesKeepRunning) {
  Settings settings = quietSettings();
  settings.groundMaxTime = 1.0;
  Scenario s(settings);
  const AgentHandle player = s.add(TeamSide::Left, 2);
  s.setMode(PlayMode::GameOver);
  for (int i = 0; i < 60 && s.countFouls(FoulType::Incapable) == 0; ++i) {
    s.sink(player, 0.1);
    s.step();
  }
  EXPECT_GT(s.countFouls(FoulType::Incapable), 0);
  EXPECT_EQ(s.mode(), PlayMode::GameOver);
}

TEST(Offside, TheModesAreDeadEnds) {
  Scenario s;
  const AgentHandle player = s.add(TeamSide::Left, 2);
  for (const PlayMode mode : {PlayMode::OffsideLeft, PlayMode::OffsideRight}) {
    s.setMode(mode);
    s.touch(player);
    s.seconds(16.0);
    EXPECT_EQ(s.mode(), mode);
  }
}

}  // namespace
}  // namespace nonet::sim::test
