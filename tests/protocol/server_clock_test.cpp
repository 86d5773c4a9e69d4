#include "nonet/protocol/server_clock.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include <gtest/gtest.h>

#include "nonet/math/random.h"
#include "nonet/protocol/standing_time.h"

namespace nonet::protocol {
namespace {

// The time that the server prints after so many steps from a start.
class PrintedTime {
 public:
  explicit PrintedTime(float start) : time_(start) {}
  double next() {
    time_ += 0.02F;
    char text[32];
    std::snprintf(text, sizeof text, "%.2f", static_cast<double>(time_));
    return std::atof(text);
  }

 private:
  float time_;
};

// Days: steps of 0.0195, 0.0234, 0.0156 and 0.0313 s, and where one becomes another.
const float kDays[] = {0.0F,     8190.0F,   32760.0F,  60000.0F,  65500.0F,
                       66000.0F, 131000.0F, 140000.0F, 262100.0F, 270000.0F};

TEST(ServerClock, EveryMessageIsOneCycleForDays) {
  for (const float start : kDays) {
    PrintedTime time(start);
    ServerClock clock;
    for (int cycle = 0; cycle < 100000; ++cycle)
      ASSERT_EQ(clock.cyclesUntil(time.next()), 1) << start << " " << cycle;
  }
}

TEST(ServerClock, OneLostMessageIsCountedAsOneForDays) {
  for (const float start : kDays) {
    Random random(3);
    PrintedTime time(start);
    ServerClock clock;
    clock.cyclesUntil(time.next());
    int wrong = 0;
    for (int message = 0; message < 30000; ++message) {
      const bool lost = random.uniform() < 0.1;
      if (lost) time.next();
      const double now = time.next();
      wrong += clock.cyclesUntil(now) == (lost ? 2 : 1) ? 0 : 1;
      EXPECT_EQ(clock.cyclesUntil(now), 0) << "the same again";
    }
    EXPECT_LT(wrong, 30) << start;
  }
}

TEST(ServerClock, KnowsTheStepOfA32BitSum) {
  EXPECT_NEAR(serverStep(0.0), 0.02, 1e-9);
  EXPECT_EQ(serverStep(40000.0), 5.0 / 256.0);
  EXPECT_EQ(serverStep(66000.0), 3.0 / 128.0);
  EXPECT_EQ(serverStep(140000.0), 1.0 / 64.0);
  EXPECT_EQ(serverStep(270000.0), 1.0 / 32.0);
  EXPECT_EQ(serverStep(524288.0), 0.0);
  EXPECT_FALSE(tellsSum(66000.0) || tellsSum(524288.0));
  EXPECT_TRUE(tellsSum(140000.0) && tellsSum(270000.0));
}

// Beyond 524,288 s, where somebody else counts on.
TEST(ServerClock, CountsWholeCyclesWhereTheSumStands) {
  ServerClock clock;
  for (int cycle = 0; cycle < 10000; ++cycle)
    ASSERT_EQ(clock.cyclesUntil(524288.0 + cycle * kCycleTime), 1) << cycle;
  EXPECT_EQ(clock.cyclesUntil(524288.0 + 10001 * kCycleTime), 2);
  for (const double strange : {std::nan(""), 1e30, 1e300, HUGE_VAL, -HUGE_VAL})
    EXPECT_GE(clock.cyclesUntil(strange), 0);
}

// Players of one team that came at different times count the turns alike once the game runs.
TEST(StandingTime, PlayersCountTheTurnsAlike) {
  StandingTime early, late, loses;
  float game = 0.0F;
  double before = 0.0;
  for (int cycle = 0; cycle < 20000; ++cycle) {
    if (cycle > 500) game += 0.02F;
    char text[32];
    std::snprintf(text, sizeof text, "%.2f", static_cast<double>(game));
    const double first = early.next(524288.0, std::atof(text));
    EXPECT_LT(before, first);
    before = first;
    const double second = cycle > 77 ? late.next(524288.0, std::atof(text)) : 0.0;
    const double third = cycle % 1000 > 30 ? loses.next(524288.0, std::atof(text)) : 0.0;
    if (cycle < 600) continue;
    for (const double other : {second, third})
      if (other > 0.0) {
        ASSERT_LT(std::abs(std::remainder(first - other, 0.44)), 0.021) << cycle;
      }
  }
}

// Twenty minutes, from many starts: beyond 512 s a step of the sum is 0.02002 s, and the print changes sides
// every ten seconds; there every message is to count as one cycle.
TEST(ServerClock, EveryMessageIsOneCycle) {
  Random random(1);
  for (int run = 0; run < 40; ++run) {
    PrintedTime time(run == 0 ? 0.0F : static_cast<float>(random.uniform(0.0, 4000.0)));
    ServerClock clock;
    for (int cycle = 0; cycle < 60000; ++cycle)
      ASSERT_EQ(clock.cyclesUntil(time.next()), 1) << run << " " << cycle;
  }
}

TEST(ServerClock, WhatIsLostIsCounted) {
  Random random(2);
  long wrong = 0;
  long messages = 0;
  for (int run = 0; run < 40; ++run) {
    PrintedTime time(static_cast<float>(random.uniform(0.0, 2000.0)));
    ServerClock clock;
    clock.cyclesUntil(time.next());
    for (int message = 0; message < 2000; ++message, ++messages) {
      const int cycles = random.uniform() < 0.9 ? 1 : 2 + static_cast<int>(random.below(5));
      double now = 0.0;
      for (int cycle = 0; cycle < cycles; ++cycle) now = time.next();
      wrong += clock.cyclesUntil(now) == cycles ? 0 : 1;
      EXPECT_EQ(clock.cyclesUntil(now), 0) << "the same again";
    }
  }
  // Two cycles that look like 0.03 s, just before the print changes sides, cannot be told.
  EXPECT_LT(static_cast<double>(wrong) / static_cast<double>(messages), 0.001);
}

}  // namespace
}  // namespace nonet::protocol
