// How robots are measured, moved and placed: server facts 4.8, one scenario per rule.
#include <cmath>

#include <gtest/gtest.h>

#include "nonet/sim/referee/geometry.h"

#include "sim/scenario.h"

namespace nonet::sim::test {
namespace {

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

// The offsets of the parts are taken from the torso before any move of the cycle (server facts 4.8).
TEST(Moves, ARobotMovedTwiceInOneCycleIsDisplaced) {
  Scenario s;
  const AgentHandle player = s.add(TeamSide::Left, 2);
  s.place(player, -5.0, 2.0);
  s.step(3);
  const Vector3f at = s.torso(player);
  for (const float by : {1.0F, 3.0F}) {
    s.command(fmt::format("(agent (team Left)(unum 2)(pos {} {} {}))", at.x() + by, at.y(), at.z()));
  }
  EXPECT_NEAR(s.torso(player).x(), at.x() + 3.0F + 1.0F, 1e-3);
}

TEST(Moves, AMoveByTheRefereeIsRigidAndStopsTheRobot) {
  Field f;
  const AgentHandle player = f.add(TeamSide::Left, 2);
  f.place(player, -3.0, 1.0, 30.0);
  f.play(-2.0, 1.0);
  protocol::Effectors walk;
  walk.setSpeed(model::JointId::RLeg3, 2.0);
  walk.setSpeed(model::JointId::LArm1, -2.0);
  f.sim.act(player, walk);
  f.seconds(0.2);
  const World& world = f.sim.world();
  const RobotHandle robot = f.info(player).robot;
  const auto hip = [&] { return world.bodyState(robot, model::BodyId::RThigh); };
  const World::BodyState before = hip();
  const Eigen::Vector3d offset = before.position - world.bodyState(robot, model::BodyId::Torso).position;
  ASSERT_GT(before.angularVelocity.norm(), 0.1);
  f.command("(dropBall)");
  EXPECT_NEAR(f.torso(player).x(), -4.5, 0.1) << "2.5 m behind the ball";
  EXPECT_EQ(hip().velocity.norm(), 0.0);
  EXPECT_EQ(hip().angularVelocity.norm(), 0.0);
  EXPECT_NEAR(hip().orientation.angularDistance(before.orientation), 0.0, 1e-9);
  const Eigen::Vector3d after = hip().position - world.bodyState(robot, model::BodyId::Torso).position;
  EXPECT_NEAR((after - offset).norm(), 0.0, 1e-5);
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

TEST(SafePlacing, NotWithinAMetreOfTheBall) {
  Field f;
  for (int unum = 2; unum <= 4; ++unum) {
    f.place(f.add(TeamSide::Left, unum), -14.2, -2.4 + 1.2 * (unum - 2));
  }
  const AgentHandle late = f.add(TeamSide::Left, 5);
  f.place(late, -12.0, 2.0);
  f.play();
  f.place(late, -13.4, 2.0);
  f.placeBall(-12.5, 2.2);  // near the place before the area where the player would be put
  f.step();
  ASSERT_EQ(f.countFouls(FoulType::IllegalDefence), 1);
  EXPECT_GE((f.torso(late) - f.ball()).head<2>().norm(), 1.0F);
  EXPECT_LT((f.torso(late) - f.ball()).head<2>().norm(), 2.0F);
}

TEST(SafePlacing, WithoutFurtherAttemptsTheTargetIsTaken) {
  for (const int attempts : {0, 1, 100}) {
    Settings settings = quietSettings();
    settings.maxNumSafeRepositionAttempts = attempts;
    Field f(settings);
    const AgentHandle moved = f.add(TeamSide::Right, 2);
    const AgentHandle there = f.add(TeamSide::Right, 3);
    f.setMode(PlayMode::PlayOn);
    f.place(moved, 1.0, 0.0);
    f.place(there, 2.5, 0.3);  // beside the place where clearing the circle puts the other one
    f.command("(kickOff Left)");
    f.step();
    const float distance = (f.torso(moved) - Vector3f(2.5F, 0.0F, f.torso(moved).z())).norm();
    EXPECT_EQ(distance < 0.01F, attempts < 2) << attempts << ": " << distance;
  }
}

}  // namespace
}  // namespace nonet::sim::test
