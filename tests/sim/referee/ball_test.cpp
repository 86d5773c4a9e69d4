// Who touched the ball, and the ball out of the field: server facts 4.4 and 4.5, one scenario per rule.
#include <algorithm>

#include <gtest/gtest.h>

#include "sim/scenario.h"

namespace nonet::sim::test {
namespace {

TEST(BallOut, OverTheTouchLineIsAKickInForTheOpponent) {
  for (const TeamSide side : {TeamSide::Left, TeamSide::Right}) {
    for (const double sign : {1.0, -1.0}) {
      Match m;
      m.ballFrom(m.second(side), 3.0, sign * 9.9);
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
    m.ballFrom(m.second(side), sign * 14.0, 4.0);
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
      m.ballFrom(m.second(side), sign * 14.0, y);
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

TEST(BallOut, TheHeightDoesNotMatter) {
  Match m;
  m.ballFrom(m.left2, 3.0, 9.9);
  m.placeBall(3.0, 10.1, 5.0);
  m.step();
  EXPECT_EQ(m.mode(), PlayMode::KickInRight);
}

TEST(BallOut, TheLastToucherMayHaveLeft) {
  Match m;
  m.ballFrom(m.left2, 3.0, 9.9);
  m.sim.disconnect(m.left2);
  m.step(2);
  m.placeBall(3.0, 10.1);
  m.step();
  EXPECT_EQ(m.mode(), PlayMode::KickInRight);
}

TEST(BallOut, ATouchByARobotWithoutTeamIsTheRightTeamsAtTheGoalLines) {
  struct Case {
    double x, y;
    PlayMode result;
  };
  for (const Case& c : {Case{15.1, 4.0, PlayMode::CornerKickLeft}, Case{-15.1, 4.0, PlayMode::GoalKickLeft},
                        Case{3.0, 10.1, PlayMode::PlayOn}}) {
    Match m;
    const AgentHandle nobody = m.sim.connect();
    protocol::Effectors scene;
    scene.scene = protocol::SceneEffector{};
    m.sim.act(nobody, scene);
    m.step(3);
    ASSERT_NE(m.info(nobody).robot, kNoRobot);
    m.touch(nobody);
    m.step();
    m.placeBall(c.x, c.y);
    m.step();
    EXPECT_EQ(m.mode(), c.result) << c.x << " " << c.y;
  }
}

// Two robots face each other, right foot to right foot, and the ball lies between these.
struct Duel : Scenario {
  /// The left team's player 2 connects first, or the right team's.
  explicit Duel(TeamSide first = TeamSide::Left) {
    for (const TeamSide side : {first, opponentOf(first)}) {
      (side == TeamSide::Left ? left : right) = add(side, 2);
    }
    mate = add(TeamSide::Left, 3);
    setMode(PlayMode::PlayOn);
    placeBall(3.0, 3.0);
    face(true);
    step(3);
  }
  void face(bool leftFirst) {
    for (const bool moveLeft : {leftFirst, !leftFirst}) {
      if (moveLeft) {
        place(left, -0.14, 0.055);
      } else {
        place(right, 0.14, -0.055, 180.0);
      }
    }
  }
  /// Both touch the ball in one cycle.
  void touchAtOnce() {
    placeBall(0.0, 0.0);
    step();
    const auto touches = [this](AgentHandle agent) {
      const auto contacts = sim.world().contacts();
      return std::any_of(contacts.begin(), contacts.end(), [&](const ContactPair& pair) {
        const bool ballFirst = pair.first.kind == ContactParty::Kind::Ball;
        const bool ballSecond = pair.second.kind == ContactParty::Kind::Ball;
        return (ballFirst && pair.second.robot == info(agent).robot) ||
               (ballSecond && pair.first.robot == info(agent).robot);
      });
    };
    ASSERT_TRUE(touches(left) && touches(right)) << "the scene is wrong";
  }

  AgentHandle left, right, mate;
};

// In which order collisions are found depends on what moved last; who counts does not.
TEST(BallTouch, OfTwoAtOnceTheOneWhoConnectedFirstIsTheLast) {
  for (const TeamSide first : {TeamSide::Left, TeamSide::Right}) {
    for (const bool leftMovesFirst : {false, true}) {
      Duel d(first);
      d.face(leftMovesFirst);
      d.touchAtOnce();
      d.placeBall(3.0, 10.1);
      d.step();
      EXPECT_EQ(d.mode(), first == TeamSide::Left ? PlayMode::KickInRight : PlayMode::KickInLeft);
    }
  }
}

TEST(BallTouch, AllWhoTouchAtOnceAreKnown) {
  Duel d;
  d.command("(kickOff Left)");
  d.step();
  d.touch(d.mate);
  ASSERT_TRUE(d.waitFor(PlayMode::PlayOn, 0.1));
  d.placeBall(3.0, 3.0);
  d.seconds(0.2);
  d.face(true);
  d.touchAtOnce();
  d.placeBall(15.05, 0.0);
  d.step();
  EXPECT_EQ(d.mode(), PlayMode::GoalLeft)
      << "the opponent has touched it too, so the kick-off team may score";
}

TEST(BallTouch, ASetPieceThatTwoTakeAtOnceIsTheFirstOnes) {
  Duel d;
  d.setMode(PlayMode::FreeKickRight);
  d.seconds(1.2);
  d.face(true);
  d.touchAtOnce();
  ASSERT_EQ(d.mode(), PlayMode::PlayOn);
  d.placeBall(3.0, 3.0);
  d.seconds(0.2);
  d.touch(d.left);
  d.step(2);
  EXPECT_EQ(d.mode(), PlayMode::FreeKickRight) << "left 2 was the taker and touched it twice";
}

}  // namespace
}  // namespace nonet::sim::test
