#include "nonet/motion/target_filter.h"

#include <gtest/gtest.h>

#include "nonet/math/random.h"
#include "nonet/math/types.h"

namespace nonet::motion {
namespace {

constexpr double kSmoothing = 0.6;  // s
constexpr double kNoise = 0.35;     // m
constexpr int kHold = 10;           // cycles between two changes of the noise

const Pose2 kStill;

Vector2 noise(Random& random) {
  return kNoise * Vector2(random.normal(), random.normal());
}

TEST(TargetFilter, WithoutSmoothingGivesTheTargetItself) {
  TargetFilter filter;
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const Pose2 target(noise(random), random.normal());
    const Pose2 result = filter.update(target, kStill, kCycleTime, 0.0);
    EXPECT_EQ(result.translation, target.translation);
    EXPECT_EQ(result.rotation, target.rotation);
  }
}

TEST(TargetFilter, FollowsASteadyTargetAndOneJumpAtOnce) {
  TargetFilter filter;
  for (int i = 0; i < 200; ++i) {
    const double jumped = i < 100 ? 0.0 : 1.0;
    const Pose2 target(3.0 - 0.04 * i, jumped, 0.01 * i);
    const Pose2 result = filter.update(target, kStill, kCycleTime, kSmoothing);
    EXPECT_EQ(result.translation, target.translation) << "cycle " << i;
  }
}

TEST(TargetFilter, AveragesATargetThatJumpsAboutWhileTheRobotWalks) {
  const Vector2 p_FT(4.0, 1.0);
  const Pose2 step(0.01, 0.002, 0.01);  // a curve
  double told = 0.0;
  double found = 0.0;
  Vector2 bias = Vector2::Zero();
  int cycles = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    TargetFilter filter;
    Random random(seed);
    Pose2 X_FR;
    Vector2 error = Vector2::Zero();
    for (int i = 0; i < 300; ++i) {
      X_FR = X_FR * step;
      if (i % kHold == 0) error = noise(random);
      const Pose2 target = X_FR.inverse() * Pose2(p_FT + error, 0.0);
      const Pose2 result = filter.update(target, step, kCycleTime, kSmoothing);
      if (i < 100) continue;
      const Vector2 miss = (X_FR * result).translation - p_FT;
      told += error.squaredNorm();
      found += miss.squaredNorm();
      bias += miss;
      ++cycles;
    }
  }
  // A first-order filter of time constant T on noise held for h: variance (1 - a) / (1 + a) with
  // a = exp(-h / T) at the changes, 0.17 here.
  EXPECT_LT(found, 0.3 * told);
  EXPECT_LT((bias / cycles).norm(), 0.1);
}

TEST(TargetFilter, TakesAFarJumpForAnotherTarget) {
  TargetFilter filter;
  Random random(3);
  Vector2 error = Vector2::Zero();
  for (int i = 0; i < 200; ++i) {
    if (i % kHold == 0) error = 0.3 * noise(random);
    filter.update(Pose2(Vector2(3.0, 0.0) + error, 0.0), kStill, kCycleTime, kSmoothing);
  }
  const Pose2 other(-2.0, 1.0, 0.5);
  EXPECT_EQ(filter.update(other, kStill, kCycleTime, kSmoothing).translation, other.translation);
}

TEST(TargetFilter, CalmsDownWithItsTarget) {
  TargetFilter filter;
  Random random(4);
  const Pose2 target(2.0, 0.0, 0.0);
  for (int i = 0; i < 200; ++i) {
    const Vector2 error = i % kHold == 0 ? noise(random) : Vector2::Zero();
    filter.update(Pose2(target.translation + error, 0.0), kStill, kCycleTime, kSmoothing);
  }
  for (int i = 0; i < 100; ++i) filter.update(target, kStill, kCycleTime, kSmoothing);
  EXPECT_EQ(filter.update(target, kStill, kCycleTime, kSmoothing).translation, target.translation);
}

}  // namespace
}  // namespace nonet::motion
