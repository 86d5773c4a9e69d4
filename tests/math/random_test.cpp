#include "nonet/math/random.h"

#include <array>
#include <cmath>
#include <set>
#include <vector>

#include <gtest/gtest.h>

namespace nonet {
namespace {

// First outputs for the state 1, 2, 3, 4, from the generator's reference implementation.
TEST(Random, IsXoshiro256PlusPlus) {
  Random random;
  random.setState({1, 2, 3, 4, 0, 0});
  for (const std::uint64_t expected :
       {41943041ULL, 58720359ULL, 3588806011781223ULL, 3591011842654386ULL, 9228616714210784205ULL,
        9973669472204895162ULL, 14011001112246962877ULL, 12406186145184390807ULL, 15849039046786891736ULL,
        10450023813501588000ULL}) {
    EXPECT_EQ(random.next(), expected);
  }
}

// First outputs of splitmix64 for the seed 1234567.
TEST(Random, IsSeededBySplitmix64) {
  const Random::State state = Random(1234567).state();
  EXPECT_EQ(state[0], 6457827717110365317ULL);
  EXPECT_EQ(state[1], 3203168211198807973ULL);
  EXPECT_EQ(state[2], 9817491932198370423ULL);
  EXPECT_EQ(state[3], 4593380528125082431ULL);
}

// Bounds are five standard deviations of the estimate.
TEST(Random, UniformHasItsMoments) {
  constexpr int kCount = 200000;
  Random random(1);
  double sum = 0.0;
  double squares = 0.0;
  for (int i = 0; i < kCount; ++i) {
    const double u = random.uniform();
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    sum += u;
    squares += (u - 0.5) * (u - 0.5);
  }
  EXPECT_NEAR(sum / kCount, 0.5, 5.0 * std::sqrt(1.0 / 12.0 / kCount));
  EXPECT_NEAR(squares / kCount, 1.0 / 12.0, 5.0 * std::sqrt(1.0 / 180.0 / kCount));
  for (int i = 0; i < 1000; ++i) {
    const double v = random.uniform(-3.0, 5.0);
    EXPECT_GE(v, -3.0);
    EXPECT_LT(v, 5.0);
  }
}

TEST(Random, NormalHasItsMomentsAndTails) {
  constexpr int kCount = 200000;
  Random random(2);
  double sum = 0.0;
  double square = 0.0;
  double fourth = 0.0;
  int beyondTwo = 0;
  double product = 0.0;
  double last = 0.0;
  for (int i = 0; i < kCount; ++i) {
    const double x = random.normal();
    sum += x;
    square += x * x;
    fourth += x * x * x * x;
    product += x * last;
    last = x;
    if (std::abs(x) > 2.0) ++beyondTwo;
  }
  EXPECT_NEAR(sum / kCount, 0.0, 5.0 / std::sqrt(kCount));
  EXPECT_NEAR(square / kCount, 1.0, 5.0 * std::sqrt(2.0 / kCount));
  EXPECT_NEAR(fourth / kCount, 3.0, 5.0 * std::sqrt(96.0 / kCount));
  EXPECT_NEAR(product / kCount, 0.0, 5.0 / std::sqrt(kCount));  // neighbours are independent
  const double tail = std::erfc(std::sqrt(2.0));
  EXPECT_NEAR(static_cast<double>(beyondTwo) / kCount, tail, 5.0 * std::sqrt(tail / kCount));
  EXPECT_NEAR(random.normal(7.0, 0.0), 7.0, 0.0);
}

TEST(Random, BelowIsEven) {
  constexpr int kCount = 100000;
  for (const std::uint64_t n : {2ULL, 7ULL, 11ULL}) {
    Random random(3 + n);
    std::vector<int> bins(n);
    for (int i = 0; i < kCount; ++i) {
      const std::uint64_t value = random.below(n);
      ASSERT_LT(value, n);
      ++bins[value];
    }
    const double expected = static_cast<double>(kCount) / static_cast<double>(n);
    double chiSquare = 0.0;
    for (const int count : bins) chiSquare += (count - expected) * (count - expected) / expected;
    const double freedom = static_cast<double>(n - 1);
    EXPECT_LT(chiSquare, freedom + 5.0 * std::sqrt(2.0 * freedom));
  }
  Random random(4);
  EXPECT_EQ(random.below(1), 0U);
  // So large that most raw numbers are near the rejection limit.
  for (int i = 0; i < 100; ++i) EXPECT_LT(random.below((1ULL << 63) + 1), (1ULL << 63) + 1);
}

TEST(Random, ForksAreReproducibleAndIndependent) {
  const Random parent(5);
  EXPECT_EQ(parent.fork(1).state(), parent.fork(1).state());
  EXPECT_NE(parent.fork(1).state(), Random(6).fork(1).state());
  constexpr int kStreams = 64;
  constexpr int kCount = 2000;
  std::set<std::uint64_t> seen;
  std::vector<std::vector<double>> values(kStreams);
  for (int stream = 0; stream < kStreams; ++stream) {
    Random child = parent.fork(stream);
    for (int i = 0; i < kCount; ++i) {
      const std::uint64_t bits = child.next();
      seen.insert(bits);
      values[stream].push_back(static_cast<double>(bits >> 11) * 0x1.0p-53 - 0.5);
    }
  }
  EXPECT_EQ(seen.size(), static_cast<std::size_t>(kStreams) * kCount);  // no stream repeats another
  double worst = 0.0;
  for (int a = 0; a < kStreams; ++a) {
    for (int b = 0; b < a; ++b) {
      double product = 0.0;
      for (int i = 0; i < kCount; ++i) product += values[a][i] * values[b][i];
      worst = std::max(worst, std::abs(product) * 12.0 / std::sqrt(kCount));
    }
  }
  EXPECT_LT(worst, 5.5);  // correlation in standard deviations, the largest of 2016 pairs
}

TEST(Random, StateContinuesWithTheSecondNormal) {
  Random random(9);
  random.normal();  // the second value of the pair is pending now
  const Random::State state = random.state();
  const std::array<double, 3> expected{random.normal(), random.normal(), random.uniform()};
  Random restored(1);
  restored.setState(state);
  EXPECT_EQ(restored.normal(), expected[0]);
  EXPECT_EQ(restored.normal(), expected[1]);
  EXPECT_EQ(restored.uniform(), expected[2]);
}

}  // namespace
}  // namespace nonet
