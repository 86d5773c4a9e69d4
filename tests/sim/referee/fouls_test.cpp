// Fouls by posture and place, and their punishment: server facts 4.10, one scenario per rule.
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "sim/scenario.h"

namespace nonet::sim::test {
namespace {

TEST(Incapable, AFieldPlayerOnTheGroundForFifteenSeconds) {
  Field f;
  const AgentHandle player = f.add(TeamSide::Left, 2);
  f.place(player, -5.0, 2.0);
  f.play();
  f.holdAt(player, 0.1, 14.8);
  EXPECT_EQ(f.countFouls(FoulType::Incapable), 0);
  f.holdAt(player, 0.1, 0.4);
  EXPECT_GT(f.countFouls(FoulType::Incapable), 0);
}

TEST(Incapable, AFieldPlayerNotStandingForThirtySeconds) {
  Field f;
  const AgentHandle player = f.add(TeamSide::Left, 2);
  f.place(player, -5.0, 2.0);
  f.play();
  f.holdAt(player, 0.2, 29.8);
  EXPECT_EQ(f.countFouls(FoulType::Incapable), 0);
  f.holdAt(player, 0.2, 0.4);
  EXPECT_GT(f.countFouls(FoulType::Incapable), 0);
}

TEST(Incapable, TheGoalkeeperHasTwiceTheTime) {
  Field f;
  const AgentHandle goalie = f.add(TeamSide::Left, 1);
  f.place(goalie, -14.5, 0.0);
  f.play();
  f.holdAt(goalie, 0.1, 29.8);
  EXPECT_EQ(f.countFouls(FoulType::Incapable), 0);
  f.holdAt(goalie, 0.1, 0.4);
  EXPECT_GT(f.countFouls(FoulType::Incapable), 0);
}

TEST(Incapable, StandingForHalfASecondClearsTheCount) {
  Settings settings = quietSettings();
  settings.notStandingMaxTime = 2.0;
  settings.groundMaxTime = 2.0;
  Field f(settings);
  const AgentHandle player = f.add(TeamSide::Left, 2);
  f.place(player, -5.0, 2.0);
  f.play();
  f.holdAt(player, 0.1, 1.8);
  f.holdAt(player, 0.385, 0.6);
  f.holdAt(player, 0.1, 1.8);
  EXPECT_EQ(f.countFouls(FoulType::Incapable), 0);
  f.holdAt(player, 0.385, 0.3);  // clears "on the ground", not "not standing"
  f.holdAt(player, 0.2, 0.4);
  EXPECT_GT(f.countFouls(FoulType::Incapable), 0);
}

TEST(Incapable, DoesNotCountBesideTheField) {
  Settings settings = quietSettings();
  settings.groundMaxTime = 1.0;
  Field f(settings);
  const AgentHandle player = f.add(TeamSide::Left, 2);
  f.place(player, -5.0, 10.3);
  f.play();
  f.holdAt(player, 0.1, 2.0);
  EXPECT_EQ(f.countFouls(FoulType::Incapable), 0);
}

TEST(Incapable, TheGoalkeeperHasALongerTimeWithoutStandingToo) {
  Settings settings = quietSettings();
  settings.notStandingMaxTime = 0.5;
  settings.goalieNotStandingMaxTime = 1.0;
  Field f(settings);
  const AgentHandle goalie = f.add(TeamSide::Left, 1);
  f.place(goalie, -14.5, 0.0);
  f.play();
  f.holdAt(goalie, 0.2, 0.9);
  EXPECT_EQ(f.countFouls(FoulType::Incapable), 0);
  f.holdAt(goalie, 0.2, 0.4);
  EXPECT_GT(f.countFouls(FoulType::Incapable), 0);
  EXPECT_EQ(Settings{}.goalieNotStandingMaxTime, 2.0 * Settings{}.notStandingMaxTime);
}

TEST(Incapable, CountsBehindTheGoalLine) {
  Settings settings = quietSettings();
  settings.groundMaxTime = 0.5;
  Field f(settings);
  const AgentHandle player = f.add(TeamSide::Left, 2);
  f.place(player, -17.0, 2.0);
  f.play();
  f.holdAt(player, 0.1, 0.7);
  EXPECT_GT(f.countFouls(FoulType::Incapable), 0);
}

// Held in the air for 25 cycles, z = 1.0 + 0.01 n with n from 2, then put outside; one record per cycle.
TEST(Punishment, HoldsTheRobotInTheAirAndPutsItOutside) {
  for (const TeamSide side : {TeamSide::Left, TeamSide::Right}) {
    for (const double ballY : {8.0, -8.0}) {
      Settings settings = quietSettings();
      settings.groundMaxTime = 0.5;
      Field f(settings);
      const AgentHandle player = f.add(side, 4);
      f.place(player, side == TeamSide::Left ? -5.0 : 5.0, 2.0);
      f.play(0.0, ballY);
      const Vector3f before = f.torso(player);
      f.holdAt(player, 0.1, 1.0);
      ASSERT_GT(f.countFouls(FoulType::Incapable), 0);
      EXPECT_NEAR(f.torso(player).z(), 1.02, 1e-3);
      EXPECT_NEAR(f.torso(player).x(), before.x(), 0.02);
      for (int n = 3; n <= 26; ++n) {
        f.step();
        EXPECT_NEAR(f.torso(player).z(), 1.0 + 0.01 * n, 1e-3);
      }
      f.step();
      const double sign = side == TeamSide::Left ? -1.0 : 1.0;
      EXPECT_NEAR(f.torso(player).x(), sign * 0.6 * 3, 1e-3);
      EXPECT_NEAR(f.torso(player).y(), ballY < 0 ? 10.5 : -10.5, 1e-3) << "on the side away from the ball";
      EXPECT_NEAR(f.torso(player).z(), 0.4, 1e-3);
      EXPECT_EQ(f.countFouls(FoulType::Incapable), 26);
      f.seconds(0.5);
      EXPECT_EQ(f.countFouls(FoulType::Incapable), 26);
    }
  }
}

TEST(Punishment, RecordsNameThePlayerAndCountFromOne) {
  Settings settings = quietSettings();
  settings.groundMaxTime = 0.2;
  Field f(settings);
  const AgentHandle player = f.add(TeamSide::Right, 4);
  f.place(player, 5.0, 2.0);
  f.play();
  f.holdAt(player, 0.1, 0.5);
  ASSERT_FALSE(f.sim.fouls().empty());
  for (std::size_t i = 0; i < f.sim.fouls().size(); ++i) {
    EXPECT_EQ(f.sim.fouls()[i].index, static_cast<int>(i) + 1);
    EXPECT_EQ(f.sim.fouls()[i].side, TeamSide::Right);
    EXPECT_EQ(f.sim.fouls()[i].unum, 4);
    EXPECT_EQ(f.sim.fouls()[i].type, 4);
  }
}

TEST(Punishment, AllCountersStartAnewAfterIt) {
  Settings settings = quietSettings();
  settings.groundMaxTime = 0.5;
  settings.notStandingMaxTime = 0.5;
  settings.foulHoldTime = 0.0;
  Field f(settings);
  const AgentHandle player = f.add(TeamSide::Left, 2);
  f.place(player, -5.0, 2.0);
  f.play();
  f.holdAt(player, 0.1, 0.6);
  ASSERT_EQ(f.countFouls(FoulType::Incapable), 1);
  f.place(player, -5.0, 2.0);
  f.step();
  f.holdAt(player, 0.1, 0.4);
  EXPECT_EQ(f.countFouls(FoulType::Incapable), 1);
  f.holdAt(player, 0.1, 0.2);
  EXPECT_EQ(f.countFouls(FoulType::Incapable), 2);
}

TEST(Punishment, PutsTheRobotDownAsItIsWhereNobodyStands) {
  Settings settings = quietSettings();
  settings.groundMaxTime = 0.3;
  Field f(settings);
  const AgentHandle player = f.add(TeamSide::Left, 4);
  const AgentHandle other = f.add(TeamSide::Left, 5);
  f.place(player, -5.0, 2.0, 70.0);
  f.place(other, -1.8, -10.5);  // where number 4 would be put
  f.play();
  const auto rotation = [&f, player] {
    return f.sim.world().bodyPose(f.info(player).robot, model::BodyId::Torso).rotation;
  };
  f.holdAt(player, 0.1, 0.6);
  ASSERT_EQ(f.countFouls(FoulType::Incapable), 1);
  const Eigen::Matrix3f inTheAir = rotation();
  f.step(25);
  EXPECT_LT(f.torso(player).y(), -10.0F);
  EXPECT_GT((f.torso(player) - f.torso(other)).head<2>().norm(), 0.5F);
  EXPECT_LT((rotation() - inTheAir).norm(), 0.2F);
}

TEST(Fouls, AreNotCountedBeforeKickOffAndAfterGoals) {
  Settings settings = quietSettings();
  settings.groundMaxTime = 0.3;
  settings.ruleGoalPauseTime = 100.0;
  Field f(settings);
  const AgentHandle player = f.add(TeamSide::Left, 2);
  f.place(player, -5.0, 2.0);
  f.step(2);
  f.holdAt(player, 0.1, 1.0);
  f.setMode(PlayMode::GoalLeft);
  f.holdAt(player, 0.1, 1.0);
  EXPECT_TRUE(f.sim.fouls().empty());
}

TEST(Fouls, APauseResetsTheCounters) {
  Settings settings = quietSettings();
  settings.groundMaxTime = 0.5;
  for (const bool pause : {true, false}) {
    Field f(settings);
    const AgentHandle player = f.add(TeamSide::Left, 2);
    f.place(player, -5.0, 2.0);
    f.play();
    f.holdAt(player, 0.1, 0.4);
    if (pause) f.setMode(PlayMode::GoalRight);
    f.holdAt(player, 0.1, 0.02);
    f.setMode(PlayMode::PlayOn);
    f.holdAt(player, 0.1, 0.3);
    EXPECT_EQ(f.countFouls(FoulType::Incapable) == 0, pause);
  }
}

// Four in the area, but one of them is held in the air for another foul.
TEST(Fouls, APlayerWhoWaitsForItsPunishmentIsIgnoredByTheOtherRules) {
  for (const bool foul : {true, false}) {
    Settings settings = quietSettings();
    settings.groundMaxTime = foul ? 0.3 : 100.0;
    Field f(settings);
    for (int unum = 2; unum <= 4; ++unum) {
      f.place(f.add(TeamSide::Left, unum), -14.2, -2.4 + 1.2 * (unum - 2));
    }
    const AgentHandle late = f.add(TeamSide::Left, 5);
    f.place(late, -12.0, 2.0);
    f.play();
    for (int i = 0; i < 60 && f.countFouls(FoulType::Incapable) == 0; ++i) {
      f.moveTo(f.player(TeamSide::Left, 3), -14.2, -1.2, 0.1);
      f.step();
    }
    ASSERT_EQ(f.countFouls(FoulType::Incapable) > 0, foul);
    f.place(late, -13.4, 2.0);
    f.step(3);
    EXPECT_EQ(f.countFouls(FoulType::IllegalDefence), foul ? 0 : 1);
  }
}

TEST(IllegalDefence, TheFourthPlayerToEnterIsMovedOut) {
  for (const TeamSide side : {TeamSide::Left, TeamSide::Right}) {
    const double sign = side == TeamSide::Left ? -1.0 : 1.0;
    Field f;
    std::vector<AgentHandle> inside;
    for (int unum = 2; unum <= 4; ++unum) {
      inside.push_back(f.add(side, unum));
      f.place(inside.back(), sign * 14.2, -2.4 + 1.2 * (unum - 2));
    }
    const AgentHandle late = f.add(side, 5);
    f.place(late, sign * 12.0, 2.0);
    f.play();
    f.step(2);
    EXPECT_EQ(f.countFouls(FoulType::IllegalDefence), 0) << "three are allowed";
    f.place(late, sign * 13.4, 2.0);
    f.step(2);
    EXPECT_EQ(f.countFouls(FoulType::IllegalDefence), 1);
    EXPECT_NEAR(f.torso(late).x(), sign * 12.8, 0.02) << "0.4 m before the front, the nearest edge";
    for (const AgentHandle agent : inside) EXPECT_GT(std::abs(f.torso(agent).x()), 14.0F);
    f.step(20);
    EXPECT_EQ(f.countFouls(FoulType::IllegalDefence), 1) << "one record, no removal";
  }
}

TEST(IllegalDefence, WhenTheGoalkeeperEntersTheFarthestGoes) {
  Field f;
  std::vector<AgentHandle> players;
  for (int unum = 2; unum <= 4; ++unum) {
    players.push_back(f.add(TeamSide::Left, unum));
    f.place(players.back(), unum == 3 ? -13.5 : -14.6, unum == 3 ? 2.0 : unum == 2 ? -1.2 : 0.0);
  }
  const AgentHandle goalie = f.add(TeamSide::Left, 1);
  f.place(goalie, -12.0, 0.0);
  f.play();
  f.step(2);
  f.place(goalie, -14.4, 1.1);
  f.step(2);
  EXPECT_EQ(f.countFouls(FoulType::IllegalDefence), 1);
  EXPECT_NEAR(f.torso(goalie).x(), -14.4, 0.02) << "never the goalkeeper";
  EXPECT_GT(f.torso(players[1]).x(), -13.0F) << "number 3 was the farthest from the goal";
}

TEST(IllegalDefence, OpponentsInTheAreaDoNotCount) {
  Field f;
  for (int unum = 2; unum <= 5; ++unum) {
    f.place(f.add(TeamSide::Right, unum, unum % 3), -14.0, -2.4 + 1.2 * (unum - 2));
  }
  f.play();
  f.step(3);
  EXPECT_EQ(f.countFouls(FoulType::IllegalDefence), 0);
}

TEST(IllegalDefence, WithBeamPenaltyThePlayerIsRemoved) {
  Settings settings = quietSettings();
  settings.illegalDefenseBeamPenalty = true;
  settings.foulHoldTime = 0.0;
  Scenario s(settings);
  for (int unum = 2; unum <= 4; ++unum) {
    s.place(s.add(TeamSide::Left, unum), -14.2, -2.4 + 1.2 * (unum - 2));
  }
  const AgentHandle late = s.add(TeamSide::Left, 5);
  s.place(late, -12.0, 2.0);
  s.setMode(PlayMode::PlayOn);
  s.placeBall(0.0, 8.0);
  s.step(3);
  s.place(late, -13.4, 2.0);
  s.step(3);
  EXPECT_NEAR(s.torso(late).y(), -10.5, 0.01) << "outside, away from the ball";
}

TEST(IllegalDefence, TheWayOutIsThroughTheNearestEdge) {
  Field f;
  for (int unum = 2; unum <= 4; ++unum) {
    f.place(f.add(TeamSide::Left, unum), -14.2, -2.4 + 1.2 * (unum - 2));
  }
  const AgentHandle late = f.add(TeamSide::Left, 5);
  f.place(late, -12.0, 2.0);
  f.play();
  f.place(late, -14.0, 2.6);
  f.step(2);
  EXPECT_EQ(f.countFouls(FoulType::IllegalDefence), 1);
  EXPECT_NEAR(f.torso(late).y(), 3.4, 0.02) << "0.4 m beside the area";
  EXPECT_NEAR(f.torso(late).x(), -14.0, 0.02);
}

TEST(Crowding, SecondAndThirdPlayerAtTheBallAreRemovedWhenSwitchedOn) {
  Settings settings = quietSettings();
  settings.minOppDistance = 0.8;
  settings.min2PlDistance = 0.4;
  settings.min3PlDistance = 1.0;
  settings.foulHoldTime = 0.0;
  Field f(settings);
  const AgentHandle first = f.add(TeamSide::Left, 2);
  const AgentHandle second = f.add(TeamSide::Left, 3);
  const AgentHandle opponent = f.add(TeamSide::Right, 4);
  f.place(first, -0.25, 1.0);
  f.place(second, 0.0, 1.35);
  f.place(opponent, 0.5, 1.0, 180.0);
  f.play(0.0, 1.0);
  f.step(2);
  EXPECT_GT(f.countFouls(FoulType::Crowding), 0);
  EXPECT_NEAR(std::abs(f.torso(second).y()), 10.5, 0.01);
  EXPECT_NEAR(f.torso(first).y(), 1.0, 0.1) << "the nearest may stay";
}

// The nearest, a second one at 0.35 m and an opponent at the ball.
void standAtTheBall(Field& f, int second, PlayMode mode) {
  const AgentHandle nearest = f.add(TeamSide::Left, 2);
  const AgentHandle other = f.add(TeamSide::Left, second);
  const AgentHandle opponent = f.add(TeamSide::Right, 4);
  f.place(nearest, -0.25, 1.0);
  f.place(other, 0.0, 1.35);
  f.place(opponent, 0.5, 1.0, 180.0);
  f.play(0.0, 1.0);
  f.setMode(mode);
  f.step(2);
}

TEST(Crowding, IsOffByDefault) {
  Field f;
  standAtTheBall(f, 3, PlayMode::PlayOn);
  EXPECT_EQ(f.countFouls(FoulType::Crowding), 0);
}

TEST(Crowding, TheGoalkeeperMay) {
  for (const int second : {1, 3}) {
    Settings settings = quietSettings();
    settings.minOppDistance = 0.8;
    settings.min2PlDistance = 0.4;
    Field f(settings);
    standAtTheBall(f, second, PlayMode::PlayOn);
    EXPECT_EQ(f.countFouls(FoulType::Crowding) > 0, second != 1);
  }
}

}  // namespace
}  // namespace nonet::sim::test
