#include "lab/tasks/kick_worth.h"

#include <gtest/gtest.h>

namespace nonet::lab {
namespace {

Kick flown(double forward, double height, double landing) {
  Kick kick;
  kick.forward = forward;
  kick.height = height;
  kick.highest = height;
  kick.landing = landing;
  return kick;
}

TEST(KickWorth, IsHowFarTheBallCameHoweverHigh) {
  const motion::KickHead head;
  EXPECT_DOUBLE_EQ(worthOfWay(flown(9.0, 0.04, 0.0), head, 10.0), 9.0);
  EXPECT_DOUBLE_EQ(worthOfWay(flown(9.0, 0.9, 6.0), head, 10.0), 9.0);
}

TEST(KickWorth, OfALowKickHeightCosts) {
  motion::KickHead head;
  head.low = 0.25;
  EXPECT_DOUBLE_EQ(worthOfWay(flown(9.0, 0.2, 3.0), head, 10.0), 9.0) << "low enough";
  EXPECT_DOUBLE_EQ(worthOfWay(flown(9.0, 0.35, 5.0), head, 10.0), 8.0);
}

TEST(KickWorth, OfAPassIsHowExactlyItCame) {
  motion::KickHead head;
  head.scales = true;
  const double exact = worthOfWay(flown(4.0, 0.04, 0.0), head, 4.0);
  EXPECT_DOUBLE_EQ(worthOfWay(flown(3.5, 0.04, 0.0), head, 4.0), exact - 0.5);
  EXPECT_DOUBLE_EQ(worthOfWay(flown(4.5, 0.04, 0.0), head, 4.0), exact - 0.5);
}

TEST(KickWorth, OfAChipHeightPaysUpToWhatItNeedsAndLandingFarOffCosts) {
  motion::KickHead head;
  head.clears = 0.7;
  head.lands = 4.0;
  EXPECT_DOUBLE_EQ(worthOfWay(flown(6.0, 0.5, 3.0), head, 10.0), 5.0);
  EXPECT_DOUBLE_EQ(worthOfWay(flown(6.0, 0.9, 3.0), head, 10.0), 8.0) << "0.1 m more than it needs count";
  EXPECT_DOUBLE_EQ(worthOfWay(flown(6.0, 0.9, 4.6), head, 10.0), 7.0);
}

}  // namespace
}  // namespace nonet::lab
