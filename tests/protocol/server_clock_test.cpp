#include "nonet/protocol/server_clock.h"

#include <cstdio>
#include <cstdlib>

#include <gtest/gtest.h>

#include "nonet/math/random.h"

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
