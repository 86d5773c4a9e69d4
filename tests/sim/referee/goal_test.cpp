// Goals, and those that do not count: server facts 4.4 and 4.5, one scenario per rule.
#include <gtest/gtest.h>

#include "sim/scenario.h"

namespace nonet::sim::test {
namespace {

// A ball that rolls through the goal mouth; `by` touched it before, outside the restrictions of kick-offs.
void shootAtRightGoal(Scenario& s, AgentHandle by) {
  s.touch(by);
  s.step(1);
  s.placeBall(14.7, 0.0, 0.1, 6.0, 0.0, 0.0);
}

TEST(Goal, CountsWithTheBallsCentreOverTheLine) {
  Scenario s;
  const AgentHandle player = s.add(TeamSide::Left, 2);
  s.setMode(PlayMode::PlayOn);
  s.touch(player);
  s.step();
  s.placeBall(14.99, 0.0, 0.042);
  s.step();
  EXPECT_EQ(s.mode(), PlayMode::PlayOn);
  s.placeBall(15.01, 0.0, 0.042);
  s.step();
  EXPECT_EQ(s.mode(), PlayMode::GoalLeft) << "half of the ball is enough";
  EXPECT_EQ(s.sim.match().scoreLeft, 1);
}

TEST(Goal, NotAboveOrBesideTheGoal) {
  Scenario s;
  const AgentHandle player = s.add(TeamSide::Left, 2);
  s.setMode(PlayMode::PlayOn);
  s.touch(player);
  s.step();
  s.placeBall(15.2, 1.5, 0.042);
  s.step();
  EXPECT_NE(s.mode(), PlayMode::GoalLeft);
  s.setMode(PlayMode::PlayOn);
  s.placeBall(15.2, 0.0, 1.2);
  s.step();
  EXPECT_NE(s.mode(), PlayMode::GoalLeft);
  EXPECT_EQ(s.sim.match().scoreLeft, 0);
}

TEST(Goal, AFastBallIsFoundByItsVelocity) {
  // 200 m/s: four metres per cycle, past the trigger box.
  for (const double sign : {1.0, -1.0}) {
    Scenario s;
    const AgentHandle player = s.add(TeamSide::Left, 2);
    s.setMode(PlayMode::PlayOn);
    s.touch(player);
    s.step();
    s.placeBall(sign * 15.9, 0.0, 0.3, sign * 2.0, 0.0, 0.0);
    s.step();
    EXPECT_EQ(s.mode(), sign > 0 ? PlayMode::GoalLeft : PlayMode::GoalRight);
  }
}

TEST(Goal, KickOffForTheOtherTeamAfterThePause) {
  Scenario s;
  const AgentHandle player = s.add(TeamSide::Left, 2);
  s.setMode(PlayMode::PlayOn);
  shootAtRightGoal(s, player);
  ASSERT_TRUE(s.waitFor(PlayMode::GoalLeft, 0.5));
  s.seconds(2.9);
  EXPECT_EQ(s.mode(), PlayMode::GoalLeft);
  ASSERT_TRUE(s.waitFor(PlayMode::KickOffRight, 0.2));
  EXPECT_NEAR(s.ball().x(), 0.0, 1e-3);
  EXPECT_EQ(s.sim.match().scoreLeft, 1);
  EXPECT_EQ(s.sim.match().scoreRight, 0);
}

TEST(Goal, TheKickOffTeamMayNotScoreFromTheCircle) {
  Scenario s;
  const AgentHandle kicker = s.add(TeamSide::Left, 2);
  s.add(TeamSide::Left, 3);
  s.add(TeamSide::Right, 2);  // more than two clients
  s.command("(kickOff Left)");
  s.step(3);
  s.touch(kicker);
  ASSERT_TRUE(s.waitFor(PlayMode::PlayOn, 0.2));
  s.placeBall(14.8, 0.0, 0.1, 5.0, 0.0, 0.0);
  ASSERT_TRUE(s.waitFor(PlayMode::GoalKickRight, 0.5));
  EXPECT_EQ(s.sim.match().scoreLeft, 0);
}

TEST(Goal, TheKickOffTeamMayScoreAfterAnOpponentsTouchOrOutsideTheCircle) {
  for (const bool opponentTouches : {true, false}) {
    Scenario s;
    const AgentHandle kicker = s.add(TeamSide::Left, 2);
    const AgentHandle mate = s.add(TeamSide::Left, 3);
    const AgentHandle opponent = s.add(TeamSide::Right, 2);
    s.place(mate, -8.0, 3.0);
    s.place(opponent, 6.0, 3.0);
    s.command("(kickOff Left)");
    s.step(3);
    s.touch(kicker);
    ASSERT_TRUE(s.waitFor(PlayMode::PlayOn, 0.2));
    s.seconds(0.2);
    s.touch(opponentTouches ? opponent : mate);
    s.step();
    s.placeBall(14.8, 0.0, 0.1, 5.0, 0.0, 0.0);
    EXPECT_TRUE(s.waitFor(PlayMode::GoalLeft, 0.5)) << opponentTouches;
  }
}

TEST(Goal, WithTwoClientsEverythingCounts) {
  Scenario s;
  const AgentHandle kicker = s.add(TeamSide::Left, 2);
  s.command("(kickOff Left)");
  s.step(3);
  s.touch(kicker);
  ASSERT_TRUE(s.waitFor(PlayMode::PlayOn, 0.2));
  s.placeBall(14.8, 0.0, 0.1, 5.0, 0.0, 0.0);
  EXPECT_TRUE(s.waitFor(PlayMode::GoalLeft, 0.5));
}

TEST(Goal, AnOwnGoalCountsForTheOpponent) {
  Scenario s;
  const AgentHandle player = s.add(TeamSide::Left, 2);
  s.setMode(PlayMode::PlayOn);
  s.touch(player);
  s.step();
  s.placeBall(-15.05, 0.0, 0.042);
  s.step();
  EXPECT_EQ(s.mode(), PlayMode::GoalRight);
  EXPECT_EQ(s.sim.match().scoreRight, 1);
}

TEST(Goal, AMatesTouchInTheCircleDoesNotAllowTheKickOffTeamToScore) {
  Match m;
  m.command("(kickOff Left)");
  m.place(m.left2, -0.5, 0.0);
  m.place(m.left3, -1.0, 0.8);
  m.step(2);
  m.touch(m.left2);
  ASSERT_TRUE(m.waitFor(PlayMode::PlayOn, 0.1));
  m.placeBall(0.0, -1.0);
  m.seconds(0.2);
  m.touch(m.left3);
  m.step();
  ASSERT_EQ(m.mode(), PlayMode::PlayOn);
  m.placeBall(15.05, 0.0);
  m.step();
  EXPECT_EQ(m.mode(), PlayMode::GoalKickRight);
}

TEST(Goal, TheBanOfTheKickOffTeamOutlastsTheGoalKick) {
  Match m;
  m.command("(kickOff Left)");
  m.step();
  m.touch(m.left2);
  ASSERT_TRUE(m.waitFor(PlayMode::PlayOn, 0.1));
  for (int i = 0; i < 2; ++i) {
    m.setMode(PlayMode::PlayOn);
    m.placeBall(15.05, 0.0);
    m.step();
    EXPECT_EQ(m.mode(), PlayMode::GoalKickRight);
  }
  m.setMode(PlayMode::PlayOn);
  m.touch(m.right2);
  m.step();
  m.placeBall(15.05, 0.0);
  m.step();
  EXPECT_EQ(m.mode(), PlayMode::GoalLeft) << "lifted by the opponent's touch";
}

TEST(Goal, PlayersAreClearedForTheComingKickOff) {
  Match m;
  m.place(m.left2, -1.5, 0.5);
  m.place(m.left3, 5.0, -3.0);
  m.place(m.right2, -0.6, -0.5, 180.0);
  m.place(m.right3, -5.0, 4.0, 180.0);
  m.setMode(PlayMode::GoalLeft);
  m.step(2);
  EXPECT_EQ(m.mode(), PlayMode::GoalLeft);
  EXPECT_NEAR(m.torso(m.left2).x(), -2.5, 0.01) << "out of the circle";
  EXPECT_NEAR(m.torso(m.left3).x(), -2.5, 0.01) << "into the own half";
  EXPECT_NEAR(m.torso(m.right2).x(), -0.6, 0.02) << "will kick off and may stand in the circle";
  EXPECT_NEAR(m.torso(m.right3).x(), 2.5, 0.01);
}

// A ball behind the trigger box: the line back along its velocity decides, at the left goal that forwards.
TEST(Goal, TheLineIntoTheLeftGoalIsFollowedTheWrongWay) {
  struct Shot {
    double x, y, vx, vy;
    PlayMode result;
  };
  for (const Shot& shot : {Shot{15.9, 0.9, 2.0, 1.0, PlayMode::GoalLeft},         // crossed at y = 0.47
                           Shot{15.9, 1.2, 2.0, -1.0, PlayMode::PlayOn},          // at 1.63
                           Shot{-15.9, 0.9, -2.0, 1.0, PlayMode::PlayOn},         // at 0.47, found at 1.33
                           Shot{-15.9, 1.2, -2.0, -1.0, PlayMode::GoalRight}}) {  // at 1.63, found at 0.77
    Scenario s;
    s.add(TeamSide::Left, 2);
    s.setMode(PlayMode::PlayOn);
    s.placeBall(shot.x, shot.y, 0.3, shot.vx, shot.vy, 0.0);
    s.step();
    EXPECT_EQ(s.mode(), shot.result) << shot.x << " " << shot.y;
  }
}

TEST(IndirectKick, AGoalFromItIsAGoalKick) {
  for (const PlayMode mode : {PlayMode::KickInLeft, PlayMode::FreeKickLeft}) {
    Match m;
    m.ballFrom(m.left2, 2.0, 1.0);
    m.setMode(mode);
    m.seconds(1.2);
    m.touch(m.left2);
    m.step(2);
    m.placeBall(15.05, 0.0);
    m.step();
    EXPECT_EQ(m.mode(), PlayMode::GoalKickRight) << protocol::playModeName(mode);
    EXPECT_EQ(m.sim.match().scoreLeft, 0);
  }
}

TEST(IndirectKick, AnOwnGoalFromItIsACornerForTheOpponent) {
  Match m;
  m.setMode(PlayMode::FreeKickLeft);
  m.seconds(1.2);
  m.touch(m.left2);
  m.step(2);
  m.placeBall(-15.05, 0.0);
  m.step();
  EXPECT_EQ(m.mode(), PlayMode::CornerKickRight);
  EXPECT_EQ(m.sim.match().scoreRight, 0);
}

TEST(IndirectKick, WithTwoClientsAGoalFromItCounts) {
  Scenario s;
  const AgentHandle kicker = s.add(TeamSide::Left, 2);
  s.sim.connect();
  s.setMode(PlayMode::FreeKickLeft);
  s.seconds(1.2);
  s.touch(kicker);
  s.step(2);
  ASSERT_EQ(s.mode(), PlayMode::PlayOn);
  s.placeBall(15.05, 0.0);
  s.step();
  EXPECT_EQ(s.mode(), PlayMode::GoalLeft);
}

TEST(DirectKick, AGoalFromItCounts) {
  for (const PlayMode mode : {PlayMode::CornerKickLeft, PlayMode::DirectFreeKickLeft}) {
    Match m;
    m.ballFrom(m.left2, 2.0, 1.0);
    m.setMode(mode);
    m.seconds(1.2);
    m.touch(m.left2);
    m.step(2);
    m.placeBall(15.05, 0.0);
    m.step();
    EXPECT_EQ(m.mode(), PlayMode::GoalLeft) << protocol::playModeName(mode);
  }
}

TEST(DirectKick, AnOwnGoalFromItIsACornerForTheOpponent) {
  Match m;
  m.ballFrom(m.left2, 2.0, 1.0);
  m.setMode(PlayMode::DirectFreeKickLeft);
  m.seconds(1.2);
  m.touch(m.left2);
  m.step(2);
  m.placeBall(-15.05, 0.0);
  m.step();
  EXPECT_EQ(m.mode(), PlayMode::CornerKickRight);
  EXPECT_EQ(m.sim.match().scoreRight, 0);
}

TEST(DirectKick, AGoalKickIsOne) {
  for (const bool ownGoal : {false, true}) {
    Match m;
    m.ballFrom(m.right2, -14.9, 4.0);
    m.placeBall(-15.1, 4.0);
    m.step();
    ASSERT_EQ(m.mode(), PlayMode::GoalKickLeft);
    m.seconds(1.2);
    m.place(m.left2, -14.0, 1.0);
    m.step();
    m.touch(m.left2);
    m.step();
    ASSERT_EQ(m.mode(), PlayMode::GoalKickLeft);
    m.placeBall(ownGoal ? -15.05 : 15.05, 0.0);
    m.step(2);  // the first cycle ends the goal kick
    EXPECT_EQ(m.mode(), ownGoal ? PlayMode::CornerKickRight : PlayMode::GoalLeft);
    EXPECT_EQ(m.sim.match().scoreRight, 0);
  }
}

}  // namespace
}  // namespace nonet::sim::test
