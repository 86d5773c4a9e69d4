#include "nonet/lab/common/statistics.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "nonet/math/random.h"

namespace nonet::lab {
namespace {

TEST(Statistics, EstimatesMeanAndInterval) {
  // 1..9: mean 5, standard deviation 2.738613, t(0.975, 8) = 2.306004.
  const Estimate e = estimate({1, 2, 3, 4, 5, 6, 7, 8, 9});
  EXPECT_DOUBLE_EQ(e.mean, 5.0);
  EXPECT_NEAR(e.ci95, 2.306004 * 2.738613 / 3.0, 1e-5);
  EXPECT_EQ(estimate({}).mean, 0.0);
  EXPECT_EQ(estimate({3.0}).ci95, 0.0);
}

TEST(Statistics, QuantileIsTheNearestRank) {
  Random random(1);
  std::vector<double> sample;
  for (int i = 0; i < 201; ++i) sample.push_back(random.normal());
  std::vector<double> sorted = sample;
  std::sort(sorted.begin(), sorted.end());
  for (const double share : {0.0, 0.05, 0.5, 0.95, 1.0})
    EXPECT_EQ(quantile(sample, share), sorted[static_cast<std::size_t>(std::lround(200.0 * share))]);
  EXPECT_EQ(quantile({}, 0.5), 0.0);
}

}  // namespace
}  // namespace nonet::lab
