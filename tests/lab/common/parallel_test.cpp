#include "lab/common/parallel.h"

#include <atomic>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace nonet::lab {
namespace {

TEST(InParallel, DoesEveryJobOnceAndTellsOfEach) {
  for (const int threads : {1, 3}) {
    std::vector<std::atomic<int>> times(50);
    std::vector<int> told;
    inParallel(
        50, threads,
        [&](const std::string& what, int done, int all) {
          EXPECT_EQ(what, "jobs");
          EXPECT_EQ(all, 50);
          told.push_back(done);
        },
        "jobs", [&](int i) { ++times[static_cast<std::size_t>(i)]; });
    for (const auto& count : times) EXPECT_EQ(count, 1);
    ASSERT_EQ(told.size(), 50U);
    for (int i = 0; i < 50; ++i) EXPECT_EQ(told[static_cast<std::size_t>(i)], i + 1);
  }
}

// In a thread of its own an exception would end the program.
TEST(InParallel, PassesAnExceptionOnAndBeginsNoMore) {
  for (const int threads : {1, 3}) {
    std::atomic<int> begun = 0;
    try {
      inParallel(1000000, threads, [&](int) {
        ++begun;
        throw std::runtime_error("a file is missing");
      });
      ADD_FAILURE() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "a file is missing");
    }
    EXPECT_LE(begun, threads);
  }
}

}  // namespace
}  // namespace nonet::lab
