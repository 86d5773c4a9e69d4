#include "nonet/app/stop_signal.h"

#include <csignal>
#include <cstdlib>

#include <gtest/gtest.h>

namespace nonet::app {
namespace {

void raiseBoth(int first, int second) {
  const StopSignal stopSignal;
  if (StopSignal::came()) std::_Exit(2);
  std::raise(first);
  if (!StopSignal::came()) std::_Exit(3);
  std::raise(second);
  std::_Exit(4);
}

TEST(StopSignal, TheSecondEndsAtOnceWhicheverTheyAre) {
  for (const int first : {SIGINT, SIGTERM}) {
    for (const int second : {SIGINT, SIGTERM})
      EXPECT_EXIT(raiseBoth(first, second), testing::KilledBySignal(second), "") << first;
  }
}

}  // namespace
}  // namespace nonet::app
