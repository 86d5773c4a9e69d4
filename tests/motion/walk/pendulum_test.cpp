#include "nonet/motion/walk/pendulum.h"

#include <cmath>

#include <gtest/gtest.h>

namespace nonet::motion {
namespace {

using model::Side;

constexpr double kSeparation = 0.1;  // m

GaitState stepping(double phase, Side stance = Side::Left) {
  GaitState gait;
  gait.standing = false;
  gait.phase = phase;
  gait.stepDuration = 0.2;
  gait.stance = stance;
  gait.step = Pose2(0.06, 0.0, 0.0);
  return gait;
}

// x'' = k^2 x over the stance foot, by finite differences: sideways over its centre, forward over a foot that
// moves back in the walk frame by a step in a step's time.
TEST(Pendulum, SwingsAsALinearPendulum) {
  const PendulumParameters p;
  const double k2 = kGravity / p.height;
  const double h = 1e-3;  // of the phase
  const auto overFoot = [&](double phase) {
    const GaitState gait = stepping(phase);
    const double footX = gait.step.translation.x() * (0.5 - phase);
    return Vector2(pendulumOffset(p, gait, kSeparation) - Vector2(footX, 0.5 * kSeparation));
  };
  for (double phase = 0.05; phase < 1.0; phase += 0.1) {
    const double time = h * stepping(phase).stepDuration;
    const Vector2 bend = (overFoot(phase + h) - 2.0 * overFoot(phase) + overFoot(phase - h)) / (time * time);
    EXPECT_NEAR(bend.x(), k2 * overFoot(phase).x(), 1e-4 * k2) << phase;
    EXPECT_NEAR(bend.y(), k2 * overFoot(phase).y(), 1e-4 * k2) << phase;
  }
}

TEST(Pendulum, OrbitsMeetAtTheChangeOfFeet) {
  const PendulumParameters p;
  const double h = 1e-6;
  const auto at = [&](double phase, Side stance) {
    return pendulumOffset(p, stepping(phase, stance), kSeparation);
  };
  EXPECT_LT((at(1.0, Side::Left) - at(0.0, Side::Right)).norm(), 1e-12);
  const Vector2 before = (at(1.0, Side::Left) - at(1.0 - h, Side::Left)) / h;
  const Vector2 after = (at(h, Side::Right) - at(0.0, Side::Right)) / h;
  EXPECT_LT((before - after).norm(), 1e-5);
  EXPECT_GT(std::abs(before.y()), 1e-3);
}

TEST(Pendulum, ShiftAndFactorsScaleTheOrbit) {
  PendulumParameters p;
  const Vector2 natural = pendulumOffset(p, stepping(0.3), kSeparation);
  p.swayFactor = 0.5;
  p.surgeFactor = 2.0;
  const Vector2 scaled = pendulumOffset(p, stepping(0.3), kSeparation);
  EXPECT_NEAR(scaled.x(), 2.0 * natural.x(), 1e-12);
  EXPECT_NEAR(scaled.y(), 0.5 * natural.y(), 1e-12);
  p.swayFactor = 0.0;
  p.yShift = 0.012;
  EXPECT_NEAR(pendulumOffset(p, stepping(0.5), kSeparation).y(), 0.012, 1e-12);
  EXPECT_NEAR(pendulumOffset(p, stepping(0.5, Side::Right), kSeparation).y(), -0.012, 1e-12);
}

TEST(Pendulum, DoesNotSwingInAStand) {
  GaitState gait = stepping(0.3);
  gait.standing = true;
  EXPECT_TRUE(pendulumOffset(PendulumParameters{}, gait, kSeparation).isZero());
}

// Everything that moves the torso moves the soles below it the other way.
TEST(Pendulum, SolesAreBelowTheTorsoAsDeclared) {
  PendulumParameters p;
  p.feetAhead = 0.01;
  p.torsoHeight = 0.9;
  GaitState gait = stepping(0.3);
  const Vector2 p_TS(0.02, 0.05);
  const auto sole = [&] { return soleBelowTorso(p, gait, p_TS, Vector3(0.004, -0.003, 0.1), 0.4); };
  EXPECT_TRUE(sole().isApprox(Vector3(0.03, 0.05, -0.36), 1e-12));
  p.aheadPerStep = 0.1;
  EXPECT_NEAR(sole().x(), 0.03 - 0.1 * 0.06, 1e-12);
  gait.step = Pose2(-0.04, 0.02, 0.0);
  p.aheadPerStepBack = 0.3;
  p.asidePerStep = 0.2;
  EXPECT_NEAR(sole().x(), 0.03 + 0.3 * 0.04, 1e-12);
  EXPECT_NEAR(sole().y(), 0.05 - 0.2 * 0.02, 1e-12);
}

// A pendulum that accelerates by a stays h a / g ahead of its foot: there gravity and inertia balance.
TEST(Pendulum, LeadsAsAPendulumThatAccelerates) {
  PendulumParameters p;
  p.accelerationShiftX = p.accelerationShiftY = 1.0;
  GaitState gait = stepping(0.3);
  gait.acceleration = Vector2(0.5, -0.7);
  const PendulumParameters plain;
  const Vector3 lead = soleBelowTorso(plain, gait, Vector2::Zero(), Vector3::Zero(), 0.4) -
                       soleBelowTorso(p, gait, Vector2::Zero(), Vector3::Zero(), 0.4);
  EXPECT_NEAR(kGravity * lead.x(), 0.5 * p.height, 1e-12);
  EXPECT_NEAR(kGravity * lead.y(), -0.7 * p.height, 1e-12);
}

// With 1 the centre of mass is where the torso is without compensation.
TEST(Pendulum, CompensatesTheCentreOfMass) {
  PendulumParameters p;
  const GaitState gait = stepping(0.3);
  const Vector3 p_TCom(0.004, -0.003, 0.1);
  const Vector2 p_TS(0.02, 0.05);
  const Vector3 p_ST = -soleBelowTorso(p, gait, p_TS, p_TCom, 0.4);
  p.comCompensationX = p.comCompensationY = 1.0;
  const Vector3 p_SCom = p_TCom - soleBelowTorso(p, gait, p_TS, p_TCom, 0.4);
  EXPECT_NEAR(p_SCom.x(), p_ST.x(), 1e-12);
  EXPECT_NEAR(p_SCom.y(), p_ST.y(), 1e-12);
}

}  // namespace
}  // namespace nonet::motion
