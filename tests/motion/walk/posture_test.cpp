#include "nonet/motion/walk/posture.h"

#include <cmath>

#include <gtest/gtest.h>

namespace nonet::motion {
namespace {

using model::Side;

GaitState stepping(const Pose2& step) {
  GaitState gait;
  gait.standing = false;
  gait.phase = 0.75;
  gait.step = step;
  return gait;
}

TEST(WalkPosture, LeansByTheStep) {
  WalkPostureParameters p;
  p.torsoPitch = 0.05;
  p.pitchPerStep = 2.0;
  p.pitchPerStepBack = -1.0;
  p.rollPerSideStep = 0.5;
  EXPECT_NEAR(wantedLean(p, stepping(Pose2(0.03, 0.0, 0.0))).pitch, 0.05 + 0.06, 1e-12);
  EXPECT_NEAR(wantedLean(p, stepping(Pose2(-0.03, 0.0, 0.0))).pitch, 0.05 + 0.03, 1e-12);
  EXPECT_NEAR(wantedLean(p, stepping(Pose2(0.0, 0.04, 0.0))).roll, -0.02, 1e-12) << "to the left";
}

// Along gravity and acceleration together a hanging weight would not swing out: to first order.
TEST(WalkPosture, LeansIntoTheAcceleration) {
  WalkPostureParameters p;
  p.accelerationPitch = p.accelerationRoll = 1.0;
  GaitState gait = stepping(Pose2{});
  gait.acceleration = Vector2(0.2, 0.3);
  const Vector3 up = rotationOf(wantedLean(p, gait)) * Vector3::UnitZ();
  const Vector3 felt = Vector3(0.2, 0.3, kGravity).normalized();
  EXPECT_LT((up - felt).norm(), 1e-3);
  EXPECT_GT((up - Vector3::UnitZ()).norm(), 0.03);
}

// From one end of the step to the other, so that the torso does not jump when the feet change.
TEST(WalkPosture, TurnsToAndFro) {
  WalkPostureParameters p;
  p.yawPerStep = 3.0;
  GaitState gait = stepping(Pose2(0.05, 0.0, 0.0));
  const auto yaw = [&](Side stance, double phase) {
    gait.stance = stance;
    gait.phase = phase;
    return torsoYaw(p, gait);
  };
  EXPECT_NEAR(torsoYawStroke(p, gait), 0.15, 1e-12);
  EXPECT_NEAR(yaw(Side::Left, 1.0), 0.15, 1e-12) << "the right foot is ahead, and so is its hip";
  EXPECT_NEAR(yaw(Side::Right, 0.0), yaw(Side::Left, 1.0), 1e-12);
  EXPECT_NEAR(yaw(Side::Right, 0.5), 0.0, 1e-12);
  gait.standing = true;
  EXPECT_EQ(yaw(Side::Left, 1.0), 0.0);
}

TEST(WalkPosture, ArmsSwingWithTheOtherFoot) {
  WalkPostureParameters p;
  p.armPitch = -1.5;
  p.armSwing = 4.0;
  p.armYaw = 0.3;
  p.elbow = 0.1;
  const ArmAttitude arm = walkingArm(p, 0.05);
  EXPECT_NEAR(arm.pitch, -1.3, 1e-12);
  EXPECT_EQ(arm.yaw, 0.3);
  EXPECT_EQ(arm.elbow, 0.1);
}

}  // namespace
}  // namespace nonet::motion
