// Set pieces: server facts 4.5 and 4.7, one scenario per rule and transition.
#include <cmath>

#include <gtest/gtest.h>

#include "sim/scenario.h"

namespace nonet::sim::test {
namespace {

// All set pieces share pause, holding, touch and time-out.
struct Piece {
  PlayMode left;
  const char* name;
};

const Piece kPieces[] = {{PlayMode::KickInLeft, "kick-in"},
                         {PlayMode::CornerKickLeft, "corner"},
                         {PlayMode::FreeKickLeft, "indirect free kick"},
                         {PlayMode::DirectFreeKickLeft, "direct free kick"}};

TEST(SetPiece, TheBallRollsOnDuringThePauseAndIsThenHeldUntilTheTouch) {
  for (const Piece& piece : kPieces) {
    for (const TeamSide side : {TeamSide::Left, TeamSide::Right}) {
      Match m;
      m.ballFrom(m.second(side), 2.0, 1.0);
      m.setMode(forSide(side, piece.left));
      m.placeBall(2.5, 1.0);
      m.seconds(0.9);
      EXPECT_NEAR(m.ball().x(), 2.5, 0.02) << piece.name;
      m.seconds(0.2);
      EXPECT_NEAR(m.ball().x(), 2.0, 0.02) << piece.name;
      m.placeBall(4.0, 3.0, 0.5);
      m.step();
      EXPECT_NEAR(m.ball().x(), 2.0, 0.02) << piece.name << ": put back every cycle";
      EXPECT_EQ(m.mode(), forSide(side, piece.left));
    }
  }
}

TEST(SetPiece, TheFirstTouchByAnybodyEndsIt) {
  for (const Piece& piece : kPieces) {
    for (const TeamSide toucher : {TeamSide::Left, TeamSide::Right}) {
      Match m;
      m.ballFrom(m.second(TeamSide::Left), 2.0, 1.0);
      m.setMode(piece.left);
      m.seconds(0.5);
      m.touch(m.second(toucher));
      m.step(2);
      EXPECT_EQ(m.mode(), piece.left) << piece.name << ": touches during the pause do not count";
      m.seconds(0.7);
      m.touch(m.second(toucher));
      m.step(2);
      EXPECT_EQ(m.mode(), PlayMode::PlayOn) << piece.name;
    }
  }
}

TEST(SetPiece, DropBallAfterFifteenSeconds) {
  for (const Piece& piece : kPieces) {
    Match m;
    m.ballFrom(m.left2, 2.0, 1.0);
    m.setMode(piece.left);
    m.seconds(14.9);
    EXPECT_EQ(m.mode(), piece.left) << piece.name;
    EXPECT_TRUE(m.waitFor(PlayMode::PlayOn, 0.3)) << piece.name;
    EXPECT_NEAR(m.ball().x(), 2.0, 0.02) << piece.name;
  }
}

TEST(SetPiece, OpponentsLeaveTheCircle) {
  for (const Piece& piece : kPieces) {
    Match m;
    m.ballFrom(m.left2, 2.0, 1.0);
    m.setMode(piece.left);
    m.place(m.right2, 3.5, 1.5);
    m.place(m.right3, 2.0, 4.5);
    m.seconds(0.9);
    EXPECT_NEAR(m.torso(m.right2).x(), 3.5, 0.05) << piece.name << ": not during the pause";
    m.seconds(0.2);
    EXPECT_NEAR(m.torso(m.right2).x(), 4.5, 0.05) << piece.name << ": 2.5 m behind the ball";
    EXPECT_NEAR(m.torso(m.right2).y(), 1.5, 0.05) << piece.name;
    EXPECT_NEAR(m.torso(m.right3).y(), 4.5, 0.05) << piece.name << ": far enough already";
  }
}

TEST(SetPiece, OpponentsBeyondTheGoalLineGoSideways) {
  Match m;
  m.ballFrom(m.left2, 14.0, 6.0);
  m.setMode(PlayMode::KickInLeft);
  m.place(m.right2, 14.2, 6.5);
  m.seconds(1.1);
  EXPECT_NEAR(m.torso(m.right2).x(), 14.2, 0.05);
  EXPECT_NEAR(m.torso(m.right2).y(), 6.0 - 2.5, 0.05) << "towards the x axis";
}

TEST(SetPiece, KickersAreRepelledOnce) {
  Match m;
  m.ballFrom(m.left2, 2.0, 1.0);
  m.setMode(PlayMode::KickInLeft);
  m.place(m.left2, 1.7, 1.0);
  m.seconds(1.1);
  EXPECT_NEAR(m.torso(m.left2).x(), 1.5, 0.02) << "pushed radially to 0.5 m";
  m.place(m.left2, 1.7, 1.0);
  m.step(3);
  EXPECT_NEAR(m.torso(m.left2).x(), 1.7, 0.02) << "only in the first cycle after the pause";
}

TEST(SetPiece, TouchesCountFromThreeHundredthsAfterThePause) {
  for (const Piece& piece : kPieces) {
    for (const int cycle : {51, 52}) {  // 1.02 s and 1.04 s
      Match m;
      m.ballFrom(m.left2, 2.0, 1.0);
      m.setMode(piece.left);
      m.step(cycle - 1);
      m.touch(m.left2);
      m.step();
      EXPECT_EQ(m.mode(), cycle == 51 ? piece.left : PlayMode::PlayOn) << piece.name;
    }
  }
}

TEST(FreeKick, NeverFromInsideAPenaltyArea) {
  for (const double sign : {1.0, -1.0}) {
    Match m;
    m.ballFrom(m.left2, sign * 14.0, -1.0);
    m.setMode(PlayMode::DirectFreeKickLeft);
    m.seconds(1.1);
    EXPECT_NEAR(m.ball().x(), sign * 13.2, 1e-3);
    EXPECT_NEAR(m.ball().y(), -3.0, 1e-3);
  }
}

TEST(FreeKick, IsWhereTheBallWasWhenPlayStopped) {
  Match m;
  m.ballFrom(m.left2, 2.0, 1.0);
  m.setMode(PlayMode::KickInLeft);
  m.seconds(1.2);
  m.touch(m.left2);
  m.step(2);
  m.placeBall(4.0, 3.0);
  m.seconds(0.2);
  m.place(m.left2, 3.9, 3.0);  // and so it touches the ball a second time
  ASSERT_TRUE(m.waitFor(PlayMode::FreeKickRight, 0.1));
  m.placeBall(5.0, 5.0);
  m.seconds(1.1);
  EXPECT_NEAR(m.ball().x(), 4.0, 0.05);
  EXPECT_NEAR(m.ball().y(), 3.0, 0.05);
}

TEST(GoalKick, EndsWhenTheTouchedBallHasLeftTheArea) {
  for (const TeamSide side : {TeamSide::Left, TeamSide::Right}) {
    Match m;
    const double sign = side == TeamSide::Left ? -1.0 : 1.0;
    m.ballFrom(m.second(opponentOf(side)), sign * 14.9, 4.0);
    m.placeBall(sign * 15.1, 4.0);
    m.step();
    const PlayMode mode = forSide(side, PlayMode::GoalKickLeft);
    ASSERT_EQ(m.mode(), mode);
    m.seconds(1.2);
    EXPECT_NEAR(m.ball().x(), sign * 14.0, 1e-3);
    m.place(m.second(side), sign * 14.0, 1.0);
    m.step();
    m.touch(m.second(side));
    m.step();
    m.placeBall(sign * 13.5, 0.0);
    m.step(3);
    EXPECT_EQ(m.mode(), mode) << "still inside the area";
    EXPECT_NEAR(m.ball().x(), sign * 13.5, 0.02) << "and left alone";
    m.placeBall(sign * 13.1, 0.0);
    m.step();
    EXPECT_EQ(m.mode(), PlayMode::PlayOn);
  }
}

TEST(GoalKick, OpponentsLeaveTheArea) {
  Match m;
  m.ballFrom(m.right2, -14.9, 4.0);
  m.placeBall(-15.1, 4.0);
  m.step();
  ASSERT_EQ(m.mode(), PlayMode::GoalKickLeft);
  m.place(m.right2, -14.0, 2.0);
  m.place(m.left2, -14.0, -2.0);
  m.seconds(1.1);
  EXPECT_NEAR(m.torso(m.right2).x(), -13.2 + 2.5, 0.05);
  EXPECT_NEAR(m.torso(m.left2).x(), -14.0, 0.05);
}

TEST(GoalKick, DropBallAfterFifteenSeconds) {
  Match m;
  m.ballFrom(m.right2, -14.9, 4.0);
  m.placeBall(-15.1, 4.0);
  m.step();
  ASSERT_EQ(m.mode(), PlayMode::GoalKickLeft);
  m.seconds(14.9);
  EXPECT_EQ(m.mode(), PlayMode::GoalKickLeft);
  ASSERT_TRUE(m.waitFor(PlayMode::PlayOn, 0.3));
  EXPECT_NEAR(m.ball().x(), -13.2, 0.02) << "not inside the penalty area";
  EXPECT_NEAR(std::abs(m.ball().y()), 3.0, 0.02);
}

TEST(GoalKick, EndsWhenTheTouchedBallHasLeftTheField) {
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
  m.placeBall(-15.1, 2.0);
  m.step();
  EXPECT_EQ(m.mode(), PlayMode::PlayOn);
  m.step();
  EXPECT_EQ(m.mode(), PlayMode::CornerKickRight);
}

TEST(GoalKick, TheTimeLimitActsAfterTheTouchToo) {
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
  m.placeBall(-13.5, 0.0);
  m.seconds(13.6);
  EXPECT_EQ(m.mode(), PlayMode::GoalKickLeft);
  EXPECT_NEAR(m.ball().x(), -13.5, 0.05);
  ASSERT_TRUE(m.waitFor(PlayMode::PlayOn, 0.3));
  EXPECT_NEAR(m.ball().x(), -13.2, 0.02) << "dropped at the goal kick's place, that is outside the area";
}

TEST(DropBall, BothTeamsAreClearedAndTheBallStops) {
  Match m;
  m.place(m.left2, -3.0, 1.0);
  m.place(m.right2, -1.0, 1.5);
  m.step();
  m.placeBall(-2.0, 1.0, 0.042, 3.0, 0.0, 0.0);
  m.command("(dropBall)");
  m.step();
  EXPECT_EQ(m.mode(), PlayMode::PlayOn);
  EXPECT_NEAR(m.ball().x(), -2.0, 0.01);
  EXPECT_NEAR(m.torso(m.left2).x(), -4.5, 0.02);
  EXPECT_NEAR(m.torso(m.right2).x(), 0.5, 0.02);
}

TEST(DropBall, IsMovedOutOfPenaltyAreasAndInsideTheTouchLines) {
  Match m;
  m.placeBall(14.0, 1.0);
  m.command("(dropBall)");
  EXPECT_NEAR(m.ball().x(), 13.2, 1e-3);
  EXPECT_NEAR(m.ball().y(), 3.0, 1e-3);
  m.placeBall(2.0, -11.0);
  m.command("(dropBall)");
  EXPECT_NEAR(m.ball().x(), 2.0, 1e-3);
  EXPECT_NEAR(m.ball().y(), -10.0 + 0.042, 1e-3);
}

TEST(DropBall, ForgetsWhoTookTheSetPiece) {
  Match m;
  m.ballFrom(m.left2, 2.0, 1.0);
  m.setMode(PlayMode::KickInLeft);
  m.seconds(1.2);
  m.touch(m.left2);
  m.step(2);
  m.placeBall(0.0, 3.0);
  m.seconds(0.2);
  m.command("(dropBall)");
  m.step();
  m.touch(m.left2);
  m.step(2);
  EXPECT_EQ(m.mode(), PlayMode::PlayOn);
}

TEST(DoubleTouch, IsAnIndirectFreeKickForTheOpponent) {
  for (const Piece& piece : kPieces) {
    Match m;
    m.ballFrom(m.left2, 2.0, 1.0);
    m.setMode(piece.left);
    m.seconds(1.2);
    m.touch(m.left2);
    m.step(2);
    ASSERT_EQ(m.mode(), PlayMode::PlayOn) << piece.name;
    m.placeBall(0.0, 3.0);
    m.seconds(0.2);
    EXPECT_EQ(m.mode(), PlayMode::PlayOn) << piece.name;
    m.touch(m.left2);
    m.step(2);
    EXPECT_EQ(m.mode(), PlayMode::FreeKickRight) << piece.name;
  }
}

TEST(DoubleTouch, LongContactOfOneKickIsNone) {
  Match m;
  m.ballFrom(m.left2, 2.0, 1.0);
  m.setMode(PlayMode::KickInLeft);
  m.seconds(1.2);
  for (int i = 0; i < 4; ++i) {  // 0.08 s
    m.touch(m.left2);
    m.step();
  }
  m.placeBall(0.0, 3.0);
  m.seconds(0.5);
  EXPECT_EQ(m.mode(), PlayMode::PlayOn);
}

TEST(DoubleTouch, IsForgottenWhenSomebodyElseTouches) {
  Match m;
  m.ballFrom(m.left2, 2.0, 1.0);
  m.setMode(PlayMode::KickInLeft);
  m.seconds(1.2);
  m.touch(m.left2);
  m.step(2);
  m.placeBall(0.0, 3.0);
  m.seconds(0.2);
  m.touch(m.left3);
  m.step();
  m.placeBall(0.0, 3.0);
  m.seconds(0.2);
  m.touch(m.left2);
  m.step(2);
  EXPECT_EQ(m.mode(), PlayMode::PlayOn);
}

TEST(DoubleTouch, AfterAKickOffNeedsMoreThanTwoClients) {
  for (const bool two : {true, false}) {
    Scenario s;
    const AgentHandle kicker = s.add(TeamSide::Left, 2);
    s.sim.connect();
    if (!two) s.sim.connect();
    s.command("(kickOff Left)");
    s.step(3);
    s.touch(kicker);
    ASSERT_TRUE(s.waitFor(PlayMode::PlayOn, 0.2));
    s.placeBall(0.0, 3.0);
    s.seconds(0.2);
    s.touch(kicker);
    s.step(2);
    EXPECT_EQ(s.mode(), two ? PlayMode::PlayOn : PlayMode::FreeKickRight);
  }
}

TEST(DoubleTouch, AlsoByAnOpponentWhoTookTheKick) {
  Match m;
  m.ballFrom(m.left2, 2.0, 1.0);
  m.setMode(PlayMode::KickInLeft);
  m.seconds(1.2);
  m.touch(m.right2);
  m.step(2);
  m.placeBall(0.0, 3.0);
  m.seconds(0.2);
  ASSERT_EQ(m.mode(), PlayMode::PlayOn);
  m.touch(m.right2);
  m.step(2);
  EXPECT_EQ(m.mode(), PlayMode::FreeKickLeft);
}

TEST(DoubleTouch, IsJudgedBeforeTheGoal) {
  for (const bool taker : {true, false}) {
    Match m;
    m.ballFrom(m.left2, 2.0, 1.0);
    m.setMode(PlayMode::KickInLeft);
    m.seconds(1.2);
    m.touch(m.left2);
    m.step(2);
    m.placeBall(0.0, 3.0);
    m.seconds(0.2);
    const AgentHandle inTheGoal = taker ? m.left2 : m.left3;
    m.place(inTheGoal, 15.25, 0.0);
    m.step();
    m.touch(inTheGoal);
    m.step();
    EXPECT_EQ(m.mode(), taker ? PlayMode::FreeKickRight : PlayMode::GoalLeft);
  }
}

}  // namespace
}  // namespace nonet::sim::test
