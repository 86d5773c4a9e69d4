#include "nonet/lab/common/statistics.h"

#include <cmath>

#include <gtest/gtest.h>

namespace nonet::lab {
namespace {

TEST(Statistics, EstimatesMeanAndInterval) {
  // 1..9: mean 5, standard deviation 2.738613, t(0.975, 8) = 2.306004.
  const Estimate e = estimate({1, 2, 3, 4, 5, 6, 7, 8, 9});
  EXPECT_DOUBLE_EQ(e.mean, 5.0);
  EXPECT_NEAR(e.ci95, 2.306004 * 2.738613 / 3.0, 1e-5);
  EXPECT_EQ(estimate({}).mean, 0.0);
}

// One value says nothing of how others would scatter: an interval of 0 would be certainty.
TEST(Statistics, FewerThanTwoValuesHaveNoInterval) {
  for (const std::vector<double>& few : {std::vector<double>{}, {3.0}}) {
    EXPECT_TRUE(std::isnan(standardError(few)));
    EXPECT_TRUE(std::isnan(estimate(few).ci95));
  }
  EXPECT_EQ(estimate({3.0}).mean, 3.0);
  EXPECT_EQ(errorText(standardError({3.0})), "-");
  EXPECT_EQ(errorText(standardError({3.0, 5.0})), "1.000");
}

TEST(Statistics, QuantileIsAValueOfTheSample) {
  const std::vector<double> ten = {70.0, 20.0, 100.0, 10.0, 40.0, 60.0, 30.0, 90.0, 50.0, 80.0};
  EXPECT_EQ(quantile(ten, 0.0), 10.0);
  EXPECT_EQ(quantile(ten, 0.1), 20.0) << "a tenth of the way to the largest is nearest to the second";
  EXPECT_EQ(quantile(ten, 0.4), 50.0);
  EXPECT_EQ(quantile(ten, 1.0), 100.0);
  EXPECT_EQ(quantile({3.0, 1.0, 2.0}, 0.5), 2.0);
  EXPECT_EQ(quantile({}, 0.5), 0.0);
}

// By hand: 10 of 10 and 0 of 10 leave 0.722 and 0.278; 50 of 100 lie in 0.404 to 0.596.
TEST(Statistics, AShareHasAnIntervalAlsoAtItsEnds) {
  EXPECT_NEAR(estimateShare(10, 10).mean - estimateShare(10, 10).ci95, 0.722, 5e-4);
  EXPECT_NEAR(estimateShare(0, 10).ci95, 0.278, 5e-4);
  EXPECT_NEAR(estimateShare(50, 100).ci95, 0.096, 5e-4);
  EXPECT_TRUE(std::isnan(estimateShare(0, 0).ci95));
}

}  // namespace
}  // namespace nonet::lab
