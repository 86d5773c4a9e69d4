// Ball out and set pieces: server facts 4.5, 4.7 and 4.9, one scenario per rule and transition.
#include <cmath>

#include <gtest/gtest.h>

#include "scenario.h"

namespace nonet::sim::test {
namespace {

constexpr PlayMode forSide(TeamSide side, PlayMode left) {
  return side == TeamSide::Left ? left : static_cast<PlayMode>(static_cast<int>(left) + 1);
}

// PlayOn with two players of each team, away from everything. L2, L3, R2, R3.
struct Match : Scenario {
  explicit Match(const Settings& settings = quietSettings()) : Scenario(settings) {
    left2 = add(TeamSide::Left, 2);
    left3 = add(TeamSide::Left, 3);
    right2 = add(TeamSide::Right, 2);
    right3 = add(TeamSide::Right, 3);
    setMode(PlayMode::PlayOn);
    place(left2, -8.0, 5.0);
    place(left3, -8.0, -5.0);
    place(right2, 8.0, 5.0, 180.0);
    place(right3, 8.0, -5.0, 180.0);
    placeBall(0.0, 0.0);
    step(2);
  }
  AgentHandle player(TeamSide side) const { return side == TeamSide::Left ? left2 : right2; }
  AgentHandle mate(TeamSide side) const { return side == TeamSide::Left ? left3 : right3; }
  /// `by` touches the ball and it lies at (x, y) afterwards.
  void ballFrom(AgentHandle by, double x, double y) {
    touch(by);
    step();
    placeBall(x, y);
    step();
  }

  AgentHandle left2, left3, right2, right3;
};

TEST(BallOut, OverTheTouchLineIsAKickInForTheOpponent) {
  for (const TeamSide side : {TeamSide::Left, TeamSide::Right}) {
    for (const double sign : {1.0, -1.0}) {
      Match m;
      m.ballFrom(m.player(side), 3.0, sign * 9.9);
      EXPECT_EQ(m.mode(), PlayMode::PlayOn);
      m.placeBall(3.1, sign * 10.04);
      m.step();
      EXPECT_EQ(m.mode(), PlayMode::PlayOn) << "the ball must be out as a whole";
      m.placeBall(3.2, sign * 10.1);
      m.step();
      ASSERT_EQ(m.mode(), forSide(opponentOf(side), PlayMode::KickInLeft));
      m.seconds(1.1);
      EXPECT_NEAR(m.ball().x(), 3.1, 0.02) << "where it was last on the field";
      EXPECT_NEAR(m.ball().y(), sign * (10.0 - 0.042), 1e-3);
    }
  }
}

TEST(BallOut, OverTheOpponentsGoalLineIsAGoalKick) {
  for (const TeamSide side : {TeamSide::Left, TeamSide::Right}) {
    Match m;
    const double sign = side == TeamSide::Left ? 1.0 : -1.0;
    m.ballFrom(m.player(side), sign * 14.0, 4.0);
    m.placeBall(sign * 15.1, 4.0);
    m.step();
    ASSERT_EQ(m.mode(), forSide(opponentOf(side), PlayMode::GoalKickLeft));
    m.seconds(1.1);
    EXPECT_NEAR(m.ball().x(), sign * 14.0, 1e-3);
    EXPECT_NEAR(m.ball().y(), 0.0, 1e-3);
  }
}

TEST(BallOut, OverTheOwnGoalLineIsACorner) {
  for (const TeamSide side : {TeamSide::Left, TeamSide::Right}) {
    for (const double y : {4.0, -7.0}) {
      Match m;
      const double sign = side == TeamSide::Left ? -1.0 : 1.0;
      m.ballFrom(m.player(side), sign * 14.0, y);
      m.placeBall(sign * 15.1, y);
      m.step();
      ASSERT_EQ(m.mode(), forSide(opponentOf(side), PlayMode::CornerKickLeft));
      m.seconds(1.1);
      // Not the real corner.
      EXPECT_NEAR(m.ball().x(), sign * 14.958, 1e-3);
      EXPECT_NEAR(m.ball().y(), y > 0 ? 5.483 : -5.483, 1e-3);
    }
  }
}

TEST(BallOut, NothingHappensIfNobodyEverTouchedIt) {
  Match m;
  m.placeBall(3.0, 12.0);
  m.step(5);
  EXPECT_EQ(m.mode(), PlayMode::PlayOn);
}

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
      m.ballFrom(m.player(side), 2.0, 1.0);
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
      m.ballFrom(m.player(TeamSide::Left), 2.0, 1.0);
      m.setMode(piece.left);
      m.seconds(0.5);
      m.touch(m.player(toucher));
      m.step(2);
      EXPECT_EQ(m.mode(), piece.left) << piece.name << ": touches during the pause do not count";
      m.seconds(0.7);
      m.touch(m.player(toucher));
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

TEST(GoalKick, EndsWhenTheTouchedBallHasLeftTheArea) {
  for (const TeamSide side : {TeamSide::Left, TeamSide::Right}) {
    Match m;
    const double sign = side == TeamSide::Left ? -1.0 : 1.0;
    m.ballFrom(m.player(opponentOf(side)), sign * 14.9, 4.0);
    m.placeBall(sign * 15.1, 4.0);
    m.step();
    const PlayMode mode = forSide(side, PlayMode::GoalKickLeft);
    ASSERT_EQ(m.mode(), mode);
    m.seconds(1.2);
    EXPECT_NEAR(m.ball().x(), sign * 14.0, 1e-3);
    m.place(m.player(side), sign * 14.0, 1.0);
    m.step();
    m.touch(m.player(side));
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

// Pass mode
// --------------------------------------------------------------------------------------------------

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

}  // namespace
}  // namespace nonet::sim::test
