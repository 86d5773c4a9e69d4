#include "nonet/motion/walk/recovery.h"

#include <gtest/gtest.h>

namespace nonet::motion {
namespace {

RecoveryParameters parameters() {
  RecoveryParameters p;
  p.farTilt = 0.2;
  p.levelGain = 0.5;
  p.stepGain = 0.3;
  return p;
}

TEST(Recovery, DoesNothingNearTheUpright) {
  const Tilt tilt{.pitch = 0.19, .pitchRate = 9.0, .roll = -0.2, .rollRate = -9.0};
  const Attitude lean = levelled(parameters(), {.pitch = 0.1, .roll = 0.05}, tilt);
  EXPECT_EQ(lean.pitch, 0.1);
  EXPECT_EQ(lean.roll, 0.05);
  EXPECT_TRUE(landingShift(parameters(), tilt).isZero());
  EXPECT_FALSE(stumbles(parameters(), tilt));
}

// On both sides a straight line that begins at the limit.
TEST(Recovery, ActsOnWhatIsBeyondTheLimit) {
  for (const double sign : {-1.0, 1.0}) {
    const Tilt tilt{.pitch = sign * 0.5, .roll = sign * 0.3};
    const Attitude lean = levelled(parameters(), {.pitch = 0.1, .roll = 0.05}, tilt);
    EXPECT_NEAR(lean.pitch, 0.1 + sign * 0.5 * 0.3, 1e-12);
    EXPECT_NEAR(lean.roll, 0.05 + sign * 0.5 * 0.1, 1e-12);
    EXPECT_NEAR(landingShift(parameters(), tilt).x(), sign * 0.3 * 0.3, 1e-12);
    EXPECT_NEAR(landingShift(parameters(), tilt).y(), -sign * 0.3 * 0.1, 1e-12) << "y is to the left";
    EXPECT_TRUE(stumbles(parameters(), tilt));
  }
}

// With a gain of 1 legs that are commanded against the torso hang as they would below one at the limit.
TEST(Recovery, LevelledLegsStayUpright) {
  RecoveryParameters p = parameters();
  p.levelGain = 1.0;
  for (const double tilt : {0.25, 0.4, 0.6}) {
    const Attitude lean = levelled(p, Attitude{}, {.pitch = tilt});
    const Matrix3 R_GLegs = rotationOf({.pitch = tilt, .roll = 0.0}) * rotationOf(lean).transpose();
    EXPECT_TRUE(R_GLegs.isApprox(rotationOf({.pitch = p.farTilt, .roll = 0.0}), 1e-12));
  }
}

// Pitch forward and roll to the right are positive.
TEST(Recovery, APushIsAMotionToWhereItLeansButAhead) {
  RecoveryParameters p;
  p.pushedTilt = 0.12;
  p.pushedSpeed = 0.15;
  EXPECT_EQ(pushOf(p, {.pitch = -0.2}, {-0.3, 0.0}).forward, -0.3);
  EXPECT_FALSE(pushOf(p, {.pitch = -0.2}, {-0.1, 0.0}).forward) << "slow";
  EXPECT_FALSE(pushOf(p, {.pitch = -0.2}, {0.3, 0.0}).forward) << "it comes up again";
  EXPECT_FALSE(pushOf(p, {.pitch = -0.1}, {-0.3, 0.0}).forward) << "upright";
  EXPECT_FALSE(pushOf(p, {.pitch = 0.2}, {0.5, 0.0}).forward) << "ahead";
  for (const double sign : {-1.0, 1.0}) {
    const Tilt aside{.roll = -0.2 * sign};
    EXPECT_EQ(pushOf(p, aside, {0.0, 0.4 * sign}).left, 0.4 * sign);
    EXPECT_FALSE(pushOf(p, aside, {0.0, 0.1 * sign}).left) << "slow";
    EXPECT_FALSE(pushOf(p, aside, {0.0, -0.4 * sign}).left) << "it comes up again";
    EXPECT_FALSE(pushOf(p, {}, {0.0, 0.4 * sign}).left) << "upright";
    EXPECT_FALSE(pushOf(p, aside, {0.0, 0.4 * sign}).forward);
  }
}

}  // namespace
}  // namespace nonet::motion
