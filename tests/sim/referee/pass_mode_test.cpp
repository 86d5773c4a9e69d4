// Pass mode: server facts 4.9, one scenario per rule and transition.
#include <gtest/gtest.h>

#include "sim/scenario.h"

namespace nonet::sim::test {
namespace {

protocol::Effectors passRequest() {
  protocol::Effectors effectors;
  effectors.pass = true;
  return effectors;
}

struct PassMatch : Match {
  explicit PassMatch(const Settings& settings = quietSettings()) : Match(settings) {
    placeBall(0.0, 0.0);
    place(left2, -0.4, 0.0);
    seconds(0.1);
  }
  void ask(AgentHandle agent) {
    sim.act(agent, passRequest());
    step();
  }
};

TEST(PassMode, IsGrantedNearARestingBall) {
  PassMatch m;
  m.ask(m.left2);
  EXPECT_EQ(m.mode(), PlayMode::PassLeft);
}

TEST(PassMode, IsRefusedUnlessAllConditionsHold) {
  {
    PassMatch m;
    m.ask(m.left3);
    EXPECT_EQ(m.mode(), PlayMode::PlayOn) << "too far from the ball";
  }
  {
    PassMatch m;
    m.placeBall(0.0, 0.0, 0.042, 0.5, 0.0, 0.0);
    m.step();
    m.ask(m.left2);
    EXPECT_EQ(m.mode(), PlayMode::PlayOn) << "the ball moves";
  }
  {
    PassMatch m;
    m.place(m.right2, 0.8, 0.0, 180.0);
    m.step();
    m.ask(m.left2);
    EXPECT_EQ(m.mode(), PlayMode::PlayOn) << "an opponent is near the ball";
  }
  {
    PassMatch m;
    m.setMode(PlayMode::KickInLeft);
    m.ask(m.left2);
    EXPECT_EQ(m.mode(), PlayMode::KickInLeft) << "only in PlayOn";
  }
}

TEST(PassMode, EndsAfterFourSecondsOrATouch) {
  PassMatch m;
  m.ask(m.left2);
  m.seconds(3.9);
  EXPECT_EQ(m.mode(), PlayMode::PassLeft);
  EXPECT_TRUE(m.waitFor(PlayMode::PlayOn, 0.2));

  PassMatch touched;
  touched.ask(touched.left2);
  touched.step(3);
  touched.touch(touched.right2);
  touched.step(2);
  EXPECT_EQ(touched.mode(), PlayMode::PlayOn);
}

TEST(PassMode, OpponentsArePushedAway) {
  PassMatch m;
  m.ask(m.left2);
  m.place(m.right2, 0.7, 0.0, 180.0);
  m.step(2);
  EXPECT_NEAR(m.torso(m.right2).x(), 1.1, 0.02);
}

TEST(PassMode, ThreeSecondsBetweenTwoOfATeam) {
  PassMatch m;
  m.ask(m.left2);
  ASSERT_TRUE(m.waitFor(PlayMode::PlayOn, 4.2));
  m.seconds(2.8);
  m.ask(m.left2);
  EXPECT_EQ(m.mode(), PlayMode::PlayOn);
  m.seconds(0.3);
  m.ask(m.left2);
  EXPECT_EQ(m.mode(), PlayMode::PassLeft);
}

TEST(PassMode, TheTeamMayNotScoreForTenSeconds) {
  for (const double wait : {9.0, 10.5}) {
    PassMatch m;
    m.ask(m.left2);
    m.step(2);
    m.touch(m.left2);
    m.step(2);
    ASSERT_EQ(m.mode(), PlayMode::PlayOn);
    m.placeBall(3.0, 0.0);
    m.seconds(wait);
    m.placeBall(15.05, 0.0);
    m.step();
    EXPECT_EQ(m.mode(), wait < 10.0 ? PlayMode::GoalKickRight : PlayMode::GoalLeft);
  }
}

TEST(PassMode, TwoTouchesAndADistanceOfOneMetreLiftTheBan) {
  for (const bool secondPlayer : {true, false}) {
    PassMatch m;
    m.ask(m.left2);
    m.step(2);
    m.touch(m.left2);
    m.step(2);
    ASSERT_EQ(m.mode(), PlayMode::PlayOn);
    m.placeBall(3.0, 0.0);
    m.step(3);
    EXPECT_GT(m.sim.match().passModeScoreWaitLeft, 9.0F);
    m.touch(secondPlayer ? m.left3 : m.left2);
    m.step();
    m.placeBall(3.0, 0.0);
    m.step(2);
    EXPECT_EQ(m.sim.match().passModeScoreWaitLeft == 0.0F, secondPlayer);
    m.placeBall(15.05, 0.0);
    m.step();
    EXPECT_EQ(m.mode(), secondPlayer ? PlayMode::GoalLeft : PlayMode::GoalKickRight);
  }
}

TEST(PassMode, ADropBallCancelsTheBan) {
  PassMatch m;
  m.ask(m.left2);
  ASSERT_TRUE(m.waitFor(PlayMode::PlayOn, 4.2));
  EXPECT_GT(m.sim.match().passModeScoreWaitLeft, 0.0F);
  m.command("(dropBall)");
  EXPECT_EQ(m.sim.match().passModeScoreWaitLeft, 0.0F);
}

TEST(PassMode, ABallThatGoesOutMeanwhileIsAKickIn) {
  PassMatch m;
  m.touch(m.left2);
  m.step();
  m.placeBall(0.0, 0.0);
  m.seconds(0.5);
  m.place(m.left2, -0.4, 0.0);
  m.seconds(0.1);
  m.ask(m.left2);
  ASSERT_EQ(m.mode(), PlayMode::PassLeft);
  m.placeBall(0.0, 10.2);
  m.step();
  EXPECT_EQ(m.mode(), PlayMode::KickInRight);
}

TEST(PassMode, ASetPieceCancelsTheBan) {
  PassMatch m;
  m.ask(m.left2);
  ASSERT_TRUE(m.waitFor(PlayMode::PlayOn, 4.2));
  ASSERT_GT(m.sim.match().passModeScoreWaitLeft, 0.0F);
  m.setMode(PlayMode::CornerKickLeft);
  m.seconds(1.2);
  m.touch(m.left2);
  m.step(2);
  ASSERT_EQ(m.mode(), PlayMode::PlayOn);
  EXPECT_EQ(m.sim.match().passModeScoreWaitLeft, 0.0F);
}

TEST(PassMode, TheOpponentsPassModeCancelsTheBan) {
  PassMatch m;
  m.ask(m.left2);
  ASSERT_TRUE(m.waitFor(PlayMode::PlayOn, 4.2));
  m.place(m.left2, -6.0, 0.0);
  m.place(m.right2, 0.4, 0.0, 180.0);
  m.placeBall(0.0, 0.0);
  m.seconds(0.1);
  m.ask(m.right2);
  ASSERT_EQ(m.mode(), PlayMode::PassRight);
  ASSERT_TRUE(m.waitFor(PlayMode::PlayOn, 4.2));
  EXPECT_EQ(m.sim.match().passModeScoreWaitLeft, 0.0F);
  EXPECT_GT(m.sim.match().passModeScoreWaitRight, 0.0F);
}

TEST(PassMode, IsRefusedWhileTheTeamTouchesTheBall) {
  Settings settings = quietSettings();
  settings.passModeMaxBallSpeed = 100.0;
  for (const bool touches : {true, false}) {
    PassMatch m(settings);
    if (touches) m.touch(m.left2);
    m.step();
    m.placeBall(0.0, 0.0);
    m.ask(m.left2);
    EXPECT_EQ(m.mode(), touches ? PlayMode::PlayOn : PlayMode::PassLeft);
  }
}

TEST(PassMode, NeedsThePlayerAtTheBallInTheLastCycleToo) {
  PassMatch m;
  m.place(m.left2, -0.7, 0.0);
  m.step();
  m.place(m.left2, -0.4, 0.0);
  m.ask(m.left2);
  EXPECT_EQ(m.mode(), PlayMode::PlayOn);
  m.ask(m.left2);
  EXPECT_EQ(m.mode(), PlayMode::PassLeft);
}

TEST(PassMode, AGoalMeanwhileIsAGoalKickAndAnOwnGoalCounts) {
  for (const bool ownGoal : {false, true}) {
    PassMatch m;
    m.ask(m.left2);
    m.step();
    m.placeBall(ownGoal ? -15.05 : 15.05, 0.0);
    m.step();
    EXPECT_EQ(m.mode(), ownGoal ? PlayMode::GoalRight : PlayMode::GoalKickRight);
  }
}

TEST(PassMode, TouchesWithoutADistanceDoNotLiftTheBan) {
  PassMatch m;
  m.place(m.left3, -0.4, 0.6);
  m.step();
  m.ask(m.left2);
  m.step(2);
  for (const AgentHandle toucher : {m.left2, m.left3, m.left2}) {
    m.touch(toucher);
    m.step();
    m.placeBall(0.0, 0.0);
    m.step(2);
  }
  ASSERT_EQ(m.mode(), PlayMode::PlayOn);
  EXPECT_GT(m.sim.match().passModeScoreWaitLeft, 9.0F);
  m.placeBall(3.0, 0.0);
  m.step();
  EXPECT_GT(m.sim.match().passModeScoreWaitLeft, 9.0F) << "the distance alone does not either";
  m.touch(m.left2);
  m.step();
  EXPECT_EQ(m.sim.match().passModeScoreWaitLeft, 0.0F) << "one, then another, then anyone";
}

TEST(PassMode, TwoWhoTouchAtOnceLiftTheBan) {
  PassMatch m;
  m.ask(m.left2);
  ASSERT_TRUE(m.waitFor(PlayMode::PlayOn, 4.2));
  m.place(m.left2, 2.86, 0.0);
  m.place(m.left3, 3.14, 0.0, 180.0);
  m.step(3);
  EXPECT_GT(m.sim.match().passModeScoreWaitLeft, 0.0F);
  m.placeBall(3.0, -0.055);
  m.step();
  EXPECT_EQ(m.sim.match().passModeScoreWaitLeft, 0.0F);
}

}  // namespace
}  // namespace nonet::sim::test
