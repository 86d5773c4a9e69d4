// Fouls and how robots are measured and moved: server facts 4.8 and 4.10, one scenario per rule.
#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "nonet/sim/referee_geometry.h"

#include "scenario.h"

namespace nonet::sim::test {
namespace {

// PlayOn, the ball far from everybody.
struct Field : Scenario {
  explicit Field(const Settings& settings = quietSettings()) : Scenario(settings) {}
  void play(double ballX = 0.0, double ballY = 8.0) {
    setMode(PlayMode::PlayOn);
    placeBall(ballX, ballY);
    step(2);
  }
  /// Holds a robot with its torso at this height, as if it lay or knelt there.
  void holdAt(AgentHandle agent, double z, double time) {
    const Vector3f at = torso(agent);
    for (int i = 0; i < time / 0.02; ++i) {
      if (torso(agent).z() > 0.9F) return;  // the referee has taken it
      moveTo(agent, at.x(), at.y(), z);
      step();
    }
  }
  void moveTo(AgentHandle agent, double x, double y, double z) {
    const AgentInfo who = info(agent);
    command(fmt::format("(agent (team {})(unum {})(pos {} {} {}))",
                        who.side == TeamSide::Left ? "Left" : "Right", who.unum, x, y, z));
  }
};

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

// Three robots in a row, arms touching.
TEST(Touching, TheThirdRobotInAGroupIsMovedAway) {
  Field f;
  const AgentHandle a = f.add(TeamSide::Left, 2);
  const AgentHandle b = f.add(TeamSide::Right, 2);
  const AgentHandle c = f.add(TeamSide::Left, 3);
  f.place(a, 0.0, 0.0);
  f.place(b, 0.0, 0.22);
  f.place(c, 0.0, -3.0);
  f.play();
  f.step(3);
  EXPECT_EQ(f.countFouls(FoulType::Touching), 0) << "two may touch";
  f.place(a, 0.0, 0.0);
  f.place(b, 0.0, 0.22);
  f.place(c, 0.0, -0.22);
  f.step(1);
  ASSERT_EQ(f.countFouls(FoulType::Touching), 1);
  const FoulRecord foul = f.sim.fouls().back();
  EXPECT_EQ(foul.unum, 3) << "the one who was alone before";
  EXPECT_EQ(foul.side, TeamSide::Left);
  EXPECT_LT(f.torso(c).y(), -0.4F);
}

TEST(Touching, TheLargerTeamIsPunishedAndTheGoalkeeperSpared) {
  Field f;
  const AgentHandle goalie = f.add(TeamSide::Left, 1);
  const AgentHandle mate = f.add(TeamSide::Left, 3);
  const AgentHandle opponent = f.add(TeamSide::Right, 2);
  f.place(goalie, 0.0, -3.0);
  f.place(mate, 0.0, 0.0);
  f.place(opponent, 0.0, 0.22);
  f.play();
  f.step(3);
  f.place(mate, 0.0, 0.0);
  f.place(opponent, 0.0, 0.22);
  f.place(goalie, 0.0, -0.22);
  f.step(1);
  ASSERT_EQ(f.countFouls(FoulType::Touching), 1);
  EXPECT_EQ(f.sim.fouls().back().unum, 3) << "the goalkeeper came last, but its team mate goes";
}

TEST(Touching, ALargerGroupMayBeAllowed) {
  Settings settings = quietSettings();
  settings.maxTouchGroupSize = 3;
  Field f(settings);
  const AgentHandle a = f.add(TeamSide::Left, 2);
  const AgentHandle b = f.add(TeamSide::Right, 2);
  const AgentHandle c = f.add(TeamSide::Left, 3);
  f.place(a, 0.0, 0.0);
  f.place(b, 0.0, 0.22);
  f.place(c, 0.0, -0.22);
  f.play();
  f.step(3);
  EXPECT_EQ(f.countFouls(FoulType::Touching), 0);
}

TEST(Touching, WithBeamPenaltyTheRobotIsRemoved) {
  Settings settings = quietSettings();
  settings.touchingFoulBeamPenalty = true;
  settings.foulHoldTime = 0.0;
  Field f(settings);
  const AgentHandle a = f.add(TeamSide::Left, 2);
  const AgentHandle b = f.add(TeamSide::Right, 2);
  const AgentHandle c = f.add(TeamSide::Left, 3);
  f.place(a, 0.0, 0.0);
  f.place(b, 0.0, 0.22);
  f.place(c, 0.0, -3.0);
  f.play();
  f.step(2);
  f.place(a, 0.0, 0.0);
  f.place(b, 0.0, 0.22);
  f.place(c, 0.0, -0.22);
  f.step(1);
  EXPECT_NEAR(std::abs(f.torso(c).y()), 10.5, 0.01);
}

// A robot thrown at a standing opponent at 1 m/s.
struct Charge : Field {
  explicit Charge(const Settings& settings = quietSettings()) : Field(settings) {
    charger = add(TeamSide::Left, 5);
    victim = add(TeamSide::Right, 6);
  }
  void run(double ballX, double ballY) {
    place(charger, -0.5, 0.0);
    place(victim, 0.0, 0.0, 180.0);
    play(ballX, ballY);
    seconds(1.2);  // moves by the referee count for a second
    for (int i = 0; i < 40 && sim.fouls().empty(); ++i) {
      push();
      step();
    }
  }
  // 1 m/s along x, as if it walked.
  void push() {
    const AgentInfo who = info(charger);
    for (const model::BodySpec& body : model::robotModel(who.robotType).bodies()) {
      World::BodyState state = sim.world().bodyState(who.robot, body.id);
      state.velocity = Eigen::Vector3d(1.0, 0.0, 0.0);
      state.angularVelocity.setZero();
      sim.world().setBodyState(who.robot, body.id, state);
    }
    sim.world().setAsleep(who.robot, false);
  }

  AgentHandle charger, victim;
};

TEST(Charging, RunningIntoAnOpponentAwayFromTheBallIsAFoul) {
  Charge c;
  c.run(0.0, 8.0);
  ASSERT_GT(c.countFouls(FoulType::Charging), 0);
  EXPECT_EQ(c.sim.fouls()[0].side, TeamSide::Left);
  EXPECT_EQ(c.sim.fouls()[0].unum, 5);
}

TEST(Charging, CanBeSwitchedOff) {
  Settings settings = quietSettings();
  settings.useCharging = false;
  Charge c(settings);
  c.run(0.0, 8.0);
  EXPECT_EQ(c.countFouls(FoulType::Charging), 0);
}

TEST(Charging, AContactAtTheBallIsNone) {
  Charge c;
  c.place(c.charger, -0.5, 0.0);
  c.place(c.victim, 0.0, 0.0, 180.0);
  c.play(0.0, 8.0);
  c.seconds(1.2);
  for (int i = 0; i < 40; ++i) {
    c.push();
    // Above the robots: only the horizontal distance counts, and nobody touches it.
    c.placeBall(0.5 * (c.torso(c.charger).x() + c.torso(c.victim).x()), 0.0, 0.9);
    c.step();
  }
  EXPECT_EQ(c.countFouls(FoulType::Charging), 0);
}

TEST(Charging, WhoIsFartherFromTheBallRunsIntoASlowOpponent) {
  Charge c;
  c.run(0.5, 0.0);
  EXPECT_GT(c.countFouls(FoulType::Charging), 0);
}

TEST(Charging, ASlowTouchIsNone) {
  Settings settings = quietSettings();
  settings.chargingMinSpeed = 1.5;
  Charge c(settings);
  c.run(0.0, 8.0);
  EXPECT_EQ(c.countFouls(FoulType::Charging), 0);
}

TEST(Charging, WhoHasJustTouchedTheBallIsImmune) {
  Charge c;
  c.place(c.charger, -0.5, 0.0);
  c.place(c.victim, 0.0, 0.0, 180.0);
  c.play(0.0, 8.0);
  c.seconds(1.2);
  c.touch(c.charger);
  c.step();
  c.placeBall(0.0, 8.0);
  for (int i = 0; i < 40; ++i) {
    c.push();
    c.step();
  }
  EXPECT_EQ(c.countFouls(FoulType::Charging), 0);
}

TEST(Charging, TheGoalkeeperInItsAreaMay) {
  Charge c;
  const AgentHandle goalie = c.add(TeamSide::Left, 1);
  c.charger = goalie;
  c.place(goalie, -14.3, 0.0);
  c.place(c.victim, -13.8, 0.0, 180.0);
  c.play(0.0, 8.0);
  c.seconds(1.2);
  for (int i = 0; i < 40; ++i) {
    c.push();
    c.step();
  }
  EXPECT_EQ(c.countFouls(FoulType::Charging), 0);
}

TEST(Charging, NotWithinASecondAfterAMoveByTheReferee) {
  Charge c;
  c.place(c.charger, -0.5, 0.0);
  c.place(c.victim, 0.0, 0.0, 180.0);
  c.play(0.0, 8.0);
  c.seconds(1.2);
  // A drop ball on the spot moves both away and marks them.
  c.placeBall(-0.25, 0.0);
  c.command("(dropBall)");
  c.step();
  c.place(c.charger, -0.5, 0.0);
  c.place(c.victim, 0.0, 0.0, 180.0);
  c.placeBall(0.0, 8.0);
  for (int i = 0; i < 40; ++i) {
    c.push();
    c.step();
  }
  EXPECT_EQ(c.countFouls(FoulType::Charging), 0);
}

// Legs that turn into each other until boxes overlap deeply and tilted: nothing else is found (server
// facts 4.10).
void crossLegs(Scenario& s, AgentHandle agent) {
  using model::JointId;
  protocol::Effectors effectors;
  for (const auto& [joint, speed] :
       {std::pair{JointId::RLeg1, -2.0}, std::pair{JointId::RLeg2, 2.0}, std::pair{JointId::RLeg3, -2.0},
        std::pair{JointId::RLeg4, 2.0}, std::pair{JointId::RLeg5, 2.0}, std::pair{JointId::RLeg6, -1.0},
        std::pair{JointId::LLeg1, -3.0}, std::pair{JointId::LLeg2, -1.0}, std::pair{JointId::LLeg3, -2.0},
        std::pair{JointId::LLeg4, -2.0}}) {
    effectors.setSpeed(joint, speed);
  }
  for (int i = 0; i < 30 && s.countFouls(FoulType::SelfCollision) == 0; ++i) {
    s.sim.act(agent, effectors);
    s.step();
  }
}

struct SelfCollision : Field {
  explicit SelfCollision(const Settings& settings = quietSettings()) : Field(settings) {
    player = add(TeamSide::Left, 2);
    place(player, -5.0, 2.0);
    play();
  }
  bool frozen(model::JointId joint) const { return sim.world().isFrozen(info(player).robot, joint); }
  AgentHandle player;
};

TEST(SelfCollision, LegsThatOverlapAreFrozenForASecond) {
  SelfCollision s;
  crossLegs(s, s.player);
  ASSERT_EQ(s.countFouls(FoulType::SelfCollision), 1);
  using model::JointId;
  EXPECT_TRUE(s.frozen(JointId::RLeg1) && s.frozen(JointId::RLeg6));
  EXPECT_TRUE(s.frozen(JointId::LLeg1) && s.frozen(JointId::LLeg6));
  EXPECT_FALSE(s.frozen(JointId::Head1) || s.frozen(JointId::RArm1));
  s.seconds(0.96);
  EXPECT_TRUE(s.frozen(JointId::RLeg1));
  s.seconds(0.08);
  EXPECT_FALSE(s.frozen(JointId::RLeg1));
  s.seconds(1.5);
  EXPECT_EQ(s.countFouls(FoulType::SelfCollision), 1) << "cannot be frozen again for two seconds";
}

TEST(SelfCollision, FrozenJointsTakeEveryCommandAsZero) {
  SelfCollision s;
  crossLegs(s, s.player);
  ASSERT_EQ(s.countFouls(FoulType::SelfCollision), 1);
  protocol::Effectors move;
  move.setSpeed(model::JointId::RLeg5, 2.0);
  move.setSpeed(model::JointId::Head1, 2.0);
  s.sim.act(s.player, move);
  s.step(2);
  const RobotHandle robot = s.info(s.player).robot;
  const float ankle = s.sim.world().jointAngle(robot, model::JointId::RLeg5);
  const float head = s.sim.world().jointAngle(robot, model::JointId::Head1);
  s.step(5);
  EXPECT_NEAR(s.sim.world().jointAngle(robot, model::JointId::RLeg5), ankle, 0.02);
  EXPECT_GT(s.sim.world().jointAngle(robot, model::JointId::Head1), head + 0.1F);
}

TEST(SelfCollision, JointsAreReleasedWhenTheGameIsPaused) {
  SelfCollision s;
  crossLegs(s, s.player);
  ASSERT_TRUE(s.frozen(model::JointId::RLeg1));
  s.setMode(PlayMode::GoalLeft);
  s.step();
  EXPECT_FALSE(s.frozen(model::JointId::RLeg1));
}

TEST(SelfCollision, CanBePunishedByRemovalInstead) {
  Settings settings = quietSettings();
  settings.selfCollisionBeamPenalty = true;
  SelfCollision s(settings);
  crossLegs(s, s.player);
  EXPECT_GT(s.countFouls(FoulType::SelfCollision), 0);
  EXPECT_FALSE(s.frozen(model::JointId::RLeg1));
  s.seconds(0.7);
  EXPECT_NEAR(s.torso(s.player).y(), -10.5, 0.1);
}

TEST(SelfCollision, ZeroPoseHasNone) {
  for (int type = 0; type < 5; ++type) {
    Field f;
    const AgentHandle player = f.add(TeamSide::Left, 2, type);
    f.place(player, -5.0, 2.0, 0.0, 0.45);
    f.play();
    f.seconds(0.5);
    EXPECT_EQ(f.countFouls(FoulType::SelfCollision), 0) << type;
  }
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

// How robots are measured
// ---------------------------------------------------------------------------------------

TEST(Measures, TheDrawnBoxIncludesTheSelectionDisc) {
  Scenario s;
  const AgentHandle player = s.add(TeamSide::Left, 2);
  s.place(player, -5.0, 2.0, 0.0);
  s.step(3);
  const Box3 box = drawnBox(s.sim.world(), s.info(player).robot);
  const Vector3f size = box.high - box.low;
  EXPECT_NEAR(size.x(), 0.40, 0.02) << "facing +x: depth of the disc";
  EXPECT_GE(size.y(), 0.399F);
  EXPECT_NEAR(box.high.z() - box.low.z(), 0.60, 0.03) << "from the soles to the top of the head";
}

TEST(Measures, TheColliderRectangleHoldsOnlyCentres) {
  Scenario s;
  const AgentHandle player = s.add(TeamSide::Left, 2);
  s.place(player, -5.0, 2.0, 0.0);
  s.step(3);
  const Box2 rectangle = colliderRectangle(s.sim.world(), s.info(player).robot);
  // Centres of the upper arms are 0.108 m aside, those of the lower arms 0.14 m in front.
  EXPECT_NEAR(rectangle.high.y() - rectangle.low.y(), 0.216, 0.01);
  EXPECT_NEAR(rectangle.high.x() - rectangle.low.x(), 0.14, 0.02);
}

TEST(Measures, BothFollowMovesOfTheSameCycle) {
  Scenario s;
  const AgentHandle player = s.add(TeamSide::Left, 2);
  s.place(player, -5.0, 2.0, 0.0);
  s.step(3);
  const Box3 before = drawnBox(s.sim.world(), s.info(player).robot);
  const Vector3f at = s.torso(player);
  s.command(fmt::format("(agent (team Left)(unum 2)(pos {} {} {}))", at.x() + 1.0F, at.y(), at.z()));
  const Box3 after = drawnBox(s.sim.world(), s.info(player).robot);
  EXPECT_NEAR(after.low.x(), before.low.x() + 1.0F, 1e-3);
}

TEST(SafePlacing, FindsAFreePlaceBesideAnOccupiedOne) {
  Field f;
  const AgentHandle moved = f.add(TeamSide::Right, 2);
  const AgentHandle there = f.add(TeamSide::Right, 3);
  f.place(moved, 1.0, 0.0);
  f.place(there, 2.5, 0.0);  // where clearing the circle would put the other one
  f.place(f.add(TeamSide::Left, 4), -8.0, 0.0);
  f.command("(kickOff Left)");
  f.step(2);
  const Vector3f at = f.torso(moved);
  EXPECT_GT((at - f.torso(there)).norm(), 0.55F);
  EXPECT_LT((at - Vector3f(2.5F, 0.0F, 0.385F)).norm(), 1.3F) << "but near it";
}

TEST(SafePlacing, NeverInsideOrBehindAGoal) {
  Field f;
  const AgentHandle player = f.add(TeamSide::Left, 5);
  f.place(player, -15.2, 0.0);
  f.play();
  // Four in the area: the newcomer would be moved towards the nearest edge, behind the goal line.
  for (int unum = 2; unum <= 4; ++unum) f.place(f.add(TeamSide::Left, unum), -13.6, -2.0 + 1.5 * (unum - 2));
  f.step(3);
  f.place(player, -14.8, 0.4);
  f.step(2);
  const Vector3f at = f.torso(player);
  EXPECT_FALSE(std::abs(at.x()) > 15.0F && std::abs(at.y()) < 1.45F) << at.transpose();
}

TEST(SafePlacing, PlayersAreNotPutIntoTheirFullPenaltyArea) {
  Field f;
  for (int unum = 2; unum <= 4; ++unum) f.place(f.add(TeamSide::Left, unum), -14.2, -2.4 + 1.2 * (unum - 2));
  const AgentHandle player = f.add(TeamSide::Left, 5);
  f.place(player, -11.5, 2.2);
  f.add(TeamSide::Right, 2);
  f.play();
  f.touch(player);
  f.step();
  // A free kick for the right team in front of the area: clearing would put the player at x = -14.
  f.placeBall(-11.6, 2.2);
  f.step();
  f.setMode(PlayMode::DirectFreeKickRight);
  f.seconds(1.1);
  const Vector3f at = f.torso(player);
  EXPECT_FALSE(at.x() < -12.8F && std::abs(at.y()) < 3.4F) << at.transpose();
}

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

}  // namespace
}  // namespace nonet::sim::test
