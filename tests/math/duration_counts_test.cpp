#include "nonet/math/duration_counts.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "nonet/math/random.h"

namespace nonet {
namespace {

TEST(DurationCounts, AreThoseOfAList) {
  Random random(1);
  std::vector<double> list;
  DurationCounts counts;
  EXPECT_EQ(counts.longest(), 0.0);
  for (int i = 0; i < 1000; ++i) {
    list.push_back(random.uniform(0.0, 0.025));
    counts.add(list.back());
  }
  EXPECT_EQ(counts.count(), 1000);
  EXPECT_EQ(counts.longest(), *std::max_element(list.begin(), list.end()));
  for (std::size_t i = 0; i < DurationCounts::kBounds.size(); ++i) {
    const double bound = DurationCounts::kBounds[i];
    EXPECT_EQ(counts.longerThan(i),
              std::count_if(list.begin(), list.end(), [bound](double seconds) { return seconds > bound; }));
  }
}

}  // namespace
}  // namespace nonet
