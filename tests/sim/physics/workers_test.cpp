#include "sim/physics/workers.h"

#include <atomic>
#include <stdexcept>

#include <gtest/gtest.h>

namespace nonet::sim {
namespace {

TEST(StepWorkers, DoEveryPieceOnce) {
  for (const int threads : {1, 2, 4}) {
    for (const int patience : {0, 1, 1000}) {
      StepWorkers workers(threads, std::chrono::microseconds(patience));
      for (const std::size_t count : {0U, 1U, 5U, 100U, 3U}) {
        std::vector<std::atomic<int>> done(count);
        workers.run(count, [&](std::size_t i) { ++done[i]; });
        for (const auto& times : done) EXPECT_EQ(times, 1);
      }
    }
  }
}

TEST(StepWorkers, PassExceptionsOnWhenAllIsDone) {
  for (const int threads : {1, 3}) {
    StepWorkers workers(threads);
    std::atomic<int> done = 0;
    EXPECT_THROW(workers.run(10,
                             [&](std::size_t i) {
                               if (i == 3) throw std::runtime_error("three");
                               ++done;
                             }),
                 std::runtime_error);
    EXPECT_EQ(done, 9);
    std::atomic<int> sum = 0;
    workers.run(4, [&](std::size_t i) { sum += static_cast<int>(i); });
    EXPECT_EQ(sum, 6) << "they work on after an exception";
  }
}

}  // namespace
}  // namespace nonet::sim
