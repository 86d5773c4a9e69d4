#include "lab/reports/walk_speeds.h"

#include <gtest/gtest.h>

namespace nonet::lab {
namespace {

// At 0.5 m/s from the first cycle on.
WalkSpeeds walkedFor(double seconds) {
  WalkSpeeds speeds;
  for (int i = 1; i <= static_cast<int>(seconds / kCycleTime + 0.5); ++i) speeds.add(0.5 * kCycleTime * i);
  return speeds;
}

TEST(WalkSpeeds, WhoFallsWhileItAcceleratesHasNoSteadySpeed) {
  EXPECT_EQ(walkedFor(2.0).steady, 0.0);
  EXPECT_EQ(walkedFor(2.0).fromStand, 0.0);
  EXPECT_NEAR(walkedFor(3.0).fromStand, 0.5, 1e-12);
  EXPECT_NEAR(walkedFor(5.0).steady, 0.25, 1e-12) << "half of the time that is measured";
  EXPECT_NEAR(walkedFor(7.0).steady, 0.5, 1e-12);
}

}  // namespace
}  // namespace nonet::lab
