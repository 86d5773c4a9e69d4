// Beams: server facts 4.6, one scenario per rule.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "nonet/math/angle.h"

#include "sim/scenario.h"

namespace nonet::sim::test {
namespace {

using protocol::Effectors;

TEST(Beam, OnlyBeforeKickOffAndAfterGoals) {
  for (int mode = 0; mode < protocol::kPlayModeCount; ++mode) {
    Scenario scenario;
    const AgentHandle agent = scenario.add(TeamSide::Left, 2);
    scenario.setMode(static_cast<PlayMode>(mode));
    Effectors beam;
    beam.beam = Pose2(-6.0, 3.0, 0.0);
    scenario.sim.act(agent, beam);
    scenario.step();
    const bool moved = std::abs(scenario.torso(agent).x() + 6.0F) < 0.01F;
    const bool allowed = mode == 0 || mode == 13 || mode == 14;
    EXPECT_EQ(moved, allowed) << protocol::playModeName(static_cast<PlayMode>(mode));
  }
}

TEST(Beam, AnglesAndPlacesAreSeenFromTheOwnTeam) {
  Scenario scenario;
  const AgentHandle left = scenario.add(TeamSide::Left, 2);
  const AgentHandle right = scenario.add(TeamSide::Right, 2);
  for (const double angle : {0.0, 30.0, -120.0}) {
    Effectors beam;
    beam.beam = Pose2(-6.0, 3.0, toRadians(angle));
    scenario.sim.act(left, beam);
    scenario.sim.act(right, beam);
    scenario.step();
    for (const AgentHandle agent : {left, right}) {
      const double sign = agent == left ? 1.0 : -1.0;
      EXPECT_NEAR(scenario.torso(agent).x(), sign * -6.0, 1e-3);
      EXPECT_NEAR(scenario.torso(agent).y(), sign * 3.0, 1e-3);
      const ScenePose& pose = scenario.sim.world().bodyPose(scenario.info(agent).robot, model::BodyId::Torso);
      const Vector3f forward = pose.rotation.col(1);
      // Angle 0 looks at the opponent's goal; positive angles turn left.
      EXPECT_NEAR(forward.x(), sign * std::cos(toRadians(angle)), 1e-3);
      EXPECT_NEAR(forward.y(), sign * std::sin(toRadians(angle)), 1e-3);
    }
  }
}

TEST(Beam, NoiseIsUniformAndClampedAfterwards) {
  Settings settings = quietSettings();
  settings.beamNoiseXY = 0.05;
  settings.beamNoiseAngle = 10.0;
  Scenario scenario(settings);
  const AgentHandle agent = scenario.add(TeamSide::Left, 2);
  double lowest = 1.0;
  double highest = -1.0;
  bool atCentreLine = false;
  for (int i = 0; i < 60; ++i) {
    Effectors beam;
    beam.beam = Pose2(-6.0, 3.0, 0.0);
    scenario.sim.act(agent, beam);
    scenario.step();
    const double error = scenario.torso(agent).x() + 6.0;
    lowest = std::min(lowest, error);
    highest = std::max(highest, error);
  }
  EXPECT_GE(lowest, -0.0501);
  EXPECT_LE(highest, 0.0501);
  EXPECT_LT(lowest, -0.03);
  EXPECT_GT(highest, 0.03);
  for (int i = 0; i < 10; ++i) {
    Effectors beam;
    beam.beam = Pose2(-20.0, 30.0, 0.0);
    scenario.sim.act(agent, beam);
    scenario.step();
    atCentreLine = std::abs(scenario.torso(agent).x() + 15.0F) < 1e-3F;
    EXPECT_TRUE(atCentreLine) << "noise does not reach beyond the limits";
    EXPECT_NEAR(scenario.torso(agent).y(), 10.0, 1e-3);
  }
}

TEST(Beam, MovesRigidlyTurnsUprightAndStops) {
  Scenario scenario;
  const AgentHandle agent = scenario.add(TeamSide::Left, 2);
  scenario.place(agent, -6.0, 3.0);
  Effectors move;
  move.setSpeed(model::JointId::Head1, 2.0);
  move.setSpeed(model::JointId::RLeg5, 3.0);
  move.setSpeed(model::JointId::LLeg5, 3.0);
  for (int i = 0; i < 20; ++i) {  // leans and falls
    scenario.sim.act(agent, move);
    scenario.step();
  }
  const World& world = scenario.sim.world();
  const RobotHandle robot = scenario.info(agent).robot;
  ASSERT_LT(world.bodyPose(robot, model::BodyId::Torso).rotation(2, 2), 0.995F);
  ASSERT_GT(world.jointAngle(robot, model::JointId::Head1), 0.5F);
  Effectors beam;
  beam.setSpeed(model::JointId::Head1, 0.0);
  beam.setSpeed(model::JointId::RLeg5, 0.0);
  beam.setSpeed(model::JointId::LLeg5, 0.0);
  scenario.sim.act(agent, beam);
  scenario.step();
  const float head = world.jointAngle(robot, model::JointId::Head1);
  const float ankle = world.jointAngle(robot, model::JointId::RLeg5);
  beam.beam = Pose2(-8.0, -3.0, 0.0);
  scenario.sim.act(agent, beam);
  scenario.step();
  EXPECT_NEAR(scenario.torso(agent).x(), -8.0, 0.01);
  EXPECT_NEAR(world.bodyPose(robot, model::BodyId::Torso).rotation(2, 2), 1.0F, 0.005F);
  EXPECT_NEAR(world.jointAngle(robot, model::JointId::Head1), head, 0.02F);
  EXPECT_NEAR(world.jointAngle(robot, model::JointId::RLeg5), ankle, 0.02F);
  EXPECT_LT(world.bodyVelocity(robot, model::BodyId::Torso).norm(), 0.3F) << "one cycle of falling";
}

TEST(Beam, RobotsAreNotKeptApart) {
  Scenario scenario;
  const AgentHandle a = scenario.add(TeamSide::Left, 2);
  const AgentHandle b = scenario.add(TeamSide::Left, 3);
  for (const AgentHandle agent : {a, b}) {
    Effectors beam;
    beam.beam = Pose2(-6.0, agent == a ? 3.0 : 3.3, 0.0);
    scenario.sim.act(agent, beam);
  }
  scenario.step();
  EXPECT_NEAR((scenario.torso(a) - scenario.torso(b)).norm(), 0.3, 0.01);
}

TEST(Beam, BeforeKickOffTheHalfIsClearedInTheSameCycle) {
  Scenario scenario;
  const AgentHandle agent = scenario.add(TeamSide::Left, 2);
  Effectors beam;
  beam.beam = Pose2(4.0, 3.0, 0.0);
  scenario.sim.act(agent, beam);
  scenario.step();
  EXPECT_NEAR(scenario.torso(agent).x(), -2.5, 0.01) << "clamped to the halfway line, which it touches there";
  EXPECT_NEAR(scenario.torso(agent).y(), 3.0, 0.01);
}

}  // namespace
}  // namespace nonet::sim::test
