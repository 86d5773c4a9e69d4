#include "nonet/motion/walk/approach.h"

#include <cmath>

#include <gtest/gtest.h>

namespace nonet::motion {
namespace {

TEST(Approach, IsAsFastAsTheLargestStepInThatDirection) {
  const ApproachParameters p;
  const GaitParameters gait;
  const double duration = Gait::stepDuration(gait);
  for (int i = 0; i < 32; ++i) {
    const double direction = i * kPi / 16.0;
    const Pose2 target(3.0 * std::cos(direction), 3.0 * std::sin(direction), 0.0);
    const Vector2 step = speedTowards(p, gait, target, true).translation * duration;
    EXPECT_NEAR(std::remainder(std::atan2(step.y(), step.x()) - direction, 2.0 * kPi), 0.0, 1e-9);
    const double maxX = step.x() > 0.0 ? gait.maxStepX : gait.maxStepXBack;
    EXPECT_NEAR(std::hypot(step.x() / maxX, step.y() / gait.maxStepY), 1.0, 1e-9);
  }
}

TEST(Approach, SlowsDownOnlyToStop) {
  const ApproachParameters p;
  const GaitParameters gait;
  const Pose2 near(0.02, 0.0, 0.0);
  EXPECT_NEAR(speedTowards(p, gait, near, true).translation.x(), p.speedGain * 0.02, 1e-12);
  EXPECT_NEAR(speedTowards(p, gait, near, false).translation.x(), gait.maxStepX / Gait::stepDuration(gait),
              1e-12);
  EXPECT_TRUE(speedTowards(p, gait, Pose2{}, true).translation.isZero());
}

// Far away it turns to the target, near to the target's heading, and in between to a mean of both.
TEST(Approach, FacesTheTargetUntilItIsNear) {
  const ApproachParameters p;
  const GaitParameters gait;
  const auto turn = [&](double distance) {
    return speedTowards(p, gait, Pose2(0.0, distance, -0.2), true).rotation / p.turnGain;
  };
  const double most = gait.maxStepTheta / Gait::stepDuration(gait) / p.turnGain;
  EXPECT_NEAR(turn(0.24), -0.2, 1e-12);
  EXPECT_NEAR(turn(0.5), std::min(most, 0.5 * kPi), 1e-12);
  EXPECT_NEAR(turn(0.275), -0.2 + 0.1 * (0.5 * kPi + 0.2), 1e-12);
}

TEST(Approach, TurnsAtOnceIfItIsToldTo) {
  const ApproachParameters p;
  const GaitParameters gait;
  for (const double distance : {0.1, 0.4, 3.0}) {
    const Pose2 speed = speedTowards(p, gait, Pose2(0.0, distance, -0.2), false, true);
    EXPECT_NEAR(speed.rotation, -0.2 * p.turnGain, 1e-12) << distance;
    EXPECT_NEAR(speed.translation.y(), gait.maxStepY / Gait::stepDuration(gait), 1e-12);
  }
}

}  // namespace
}  // namespace nonet::motion
