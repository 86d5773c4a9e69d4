#include "nonet/lab/match/pair_statistics.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "nonet/math/random.h"

namespace nonet::lab {
namespace {

TEST(PairSummary, MeanErrorAndIntervalOfAKnownSample) {
  // By hand: mean 3, variance 2.5, standard error sqrt(2.5 / 5); t with four degrees of freedom at 97.5 %:
  // 2.776445 (any printed table).
  const std::vector<double> values = {1.0, 2.0, 3.0, 4.0, 5.0};
  const PairSummary summary = summarizePairs(values, 0.5);
  EXPECT_EQ(summary.pairs, 5);
  EXPECT_DOUBLE_EQ(summary.mean, 3.0);
  EXPECT_NEAR(summary.standardError, std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(summary.high - summary.mean, 2.776445 * std::sqrt(0.5), 1e-5);
  EXPECT_NEAR(summary.mean - summary.low, 2.776445 * std::sqrt(0.5), 1e-5);
  EXPECT_EQ(summarizePairs({}, 0.5).pairs, 0);
  EXPECT_EQ(summarizePairs(std::vector<double>{2.0}, 0.5).high, 2.0);
}

// Two pairs of goalless games are no proof that the teams are equal: as if one of them had ended with a goal,
// (0, 0.5): standard error 0.25, and with one degree of freedom t = 12.7062.
TEST(PairSummary, EqualPairsAreNotWithoutSpread) {
  const PairSummary summary = summarizePairs(std::vector<double>{0.0, 0.0}, 0.5);
  EXPECT_NEAR(summary.standardError, 0.25, 1e-12);
  EXPECT_NEAR(summary.high, 12.7062 * 0.25, 1e-3);
}

TEST(SequentialBounds, AreReadOrExplained) {
  EXPECT_EQ(parseSequentialBounds("-0.25,0.5").low, -0.25);
  EXPECT_EQ(parseSequentialBounds("-0.25,0.5").high, 0.5);
  for (const char* wrong : {"", "1", "1,1", "2,1", "a,b", "0,1x", "0,nan"}) {
    EXPECT_THROW(parseSequentialBounds(wrong), std::runtime_error) << wrong;
  }
}

// The formula with all values at hand, as it stands in the header. Values between the claims and beyond them.
TEST(SequentialTest, RatioIsThatOfAllValuesAtOnce) {
  Random random(7);
  SequentialTest test({0.0, 1.0}, 0.5);
  std::vector<double> values;
  for (int i = 0; i < 40 && test.verdict() == Verdict::Open; ++i) {
    values.push_back(random.normal(0.5, 2.0));
    test.add(values.back());
    double mean = 0.0;
    for (const double value : values) mean += value / static_cast<double>(values.size());
    double about0 = 0.25;
    double about1 = 0.25;
    for (const double value : values) {
      about0 += std::pow(value - std::min(0.0, mean), 2);
      about1 += std::pow(value - std::max(1.0, mean), 2);
    }
    double ratio = (static_cast<double>(values.size()) - 1.0) / 2.0 * std::log(about0 / about1);
    const double price = mean < 0.0 || mean > 1.0 ? SequentialTest::kPrice : 0.0;
    ratio = ratio > 0.0 ? std::max(0.0, ratio - price) : std::min(0.0, ratio + price);
    EXPECT_NEAR(test.logLikelihoodRatio(), ratio, 1e-9);
  }
  EXPECT_GE(values.size(), 6U);
}

// Nine goals in ten minutes are as far from half a goal as from none, but they are no riddle.
TEST(SequentialTest, WhatIsObviousIsDecidedAtOnce) {
  for (const double sign : {-1.0, 1.0}) {
    Random random(3);
    SequentialTest test({0.0, 0.5}, 0.5);
    int pairs = 0;
    while (test.verdict() == Verdict::Open && pairs < 100) {
      test.add(random.normal(9.0 * sign, 3.0));
      ++pairs;
    }
    EXPECT_EQ(test.verdict(), sign > 0.0 ? Verdict::High : Verdict::Low);
    EXPECT_LE(pairs, 7);
  }
}

TEST(SequentialTest, EqualPairsAreNotPairsWithoutSpread) {
  SequentialTest equal({0.0, 0.5}, 0.5);
  int pairs = 0;
  while (equal.add(0.0) == Verdict::Open && pairs < 100) ++pairs;
  EXPECT_EQ(equal.verdict(), Verdict::Low);
  EXPECT_GE(pairs + 1, SequentialTest::kFewestPairs);
  const double ratio = equal.logLikelihoodRatio();
  equal.add(100.0);
  EXPECT_EQ(equal.logLikelihoodRatio(), ratio) << "decided is decided";
}

int poisson(Random& random, double mean) {
  const double limit = std::exp(-mean);
  int count = 0;
  for (double product = random.uniform(); product > limit; product *= random.uniform()) ++count;
  return count;
}

// Ten-minute games in which both teams score as Poisson processes, A by `advantage` goals more. Returns how
// many of `tests` series ended with the verdict.
int verdicts(Verdict wanted, double advantage, double goals, const SequentialBounds& bounds, int tests,
             std::uint64_t seed) {
  Random random(seed);
  int count = 0;
  for (int i = 0; i < tests; ++i) {
    SequentialTest test(bounds, 0.5);
    for (int pair = 0; pair < 5000 && test.verdict() == Verdict::Open; ++pair) {
      double difference = 0.0;
      for (int game = 0; game < 2; ++game) {
        difference += poisson(random, goals + advantage / 2.0) - poisson(random, goals - advantage / 2.0);
      }
      test.add(difference / 2.0);
    }
    EXPECT_NE(test.verdict(), Verdict::Open);
    count += test.verdict() == wanted ? 1 : 0;
  }
  return count;
}

// 200 series each. With a true error of 5 %, 18 or more wrong ones come about once in a hundred times
// (binomial); the seeds are fixed, so this either holds or does not.
TEST(SequentialTest, BothErrorsStayAtFivePercentOverTwoHundredSimulatedSeries) {
  constexpr int kTests = 200;
  constexpr int kMost = 17;
  for (const double goals : {0.4, 1.0, 3.0}) {
    const SequentialBounds bounds{0.0, 0.5};
    EXPECT_LE(verdicts(Verdict::High, bounds.low, goals, bounds, kTests, 11), kMost) << goals;
    EXPECT_LE(verdicts(Verdict::Low, bounds.high, goals, bounds, kTests, 12), kMost) << goals;
    // Farther apart than claimed: hardly ever wrong, so the test decides by the data.
    EXPECT_LE(verdicts(Verdict::High, -0.5, goals, bounds, kTests, 13), 1) << goals;
    EXPECT_LE(verdicts(Verdict::Low, 1.0 - 0.3, goals, bounds, kTests, 14), 6) << goals;
  }
}

TEST(SequentialTest, EqualTeamsAreNotToldApart) {
  const SequentialBounds bounds{-0.25, 0.25};
  const int high = verdicts(Verdict::High, 0.0, 1.0, bounds, 200, 21);
  EXPECT_GT(high, 60) << "in the middle either verdict is as likely";
  EXPECT_LT(high, 140);
}

}  // namespace
}  // namespace nonet::lab
