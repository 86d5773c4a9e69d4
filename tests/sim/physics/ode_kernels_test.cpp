// The oracle is ODE itself: its own kernels, which the program's hide, are looked up behind them.
#include "sim/physics/ode_kernels.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include <dlfcn.h>
#include <gtest/gtest.h>

#include "nonet/math/random.h"
#include "nonet/sim/fidelity/fixed_episode.h"

namespace {

using nonet::Random;
namespace kernels = nonet::sim::ode_kernels;

using Factor = void (*)(double*, double*, unsigned, unsigned);
using Solve = void (*)(const double*, double*, unsigned, unsigned);

/// ODE's function of this (mangled) name; null if this ODE has none.
template <typename Function>
Function odes(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

std::vector<std::uint64_t> bits(const std::vector<double>& numbers) {
  std::vector<std::uint64_t> result;
  result.reserve(numbers.size());
  for (const double number : numbers) result.push_back(std::bit_cast<std::uint64_t>(number));
  return result;
}

/// Some are zero, as in a robot's equations, with either sign.
std::vector<double> numbers(std::size_t count, double zeros, Random& random) {
  std::vector<double> result(count);
  for (double& number : result) {
    number = random.uniform(-1.0, 1.0);
    if (random.uniform() < zeros) number = std::copysign(0.0, number);
  }
  return result;
}

constexpr unsigned kLargest = 150;

unsigned rowLength(unsigned n) {
  return n + 3 - (n + 3) % 4 + 4;
}

using SolveBlocks = void (*)(const double*, double*, unsigned, unsigned, const kernels::Blocks&);

void compareSolvers(const char* odesName, SolveBlocks ours) {
  const auto reference = odes<Solve>(odesName);
  if (reference == nullptr) GTEST_SKIP() << "this ODE has no " << odesName;
  Random random(5);
  for (unsigned n = 1; n <= kLargest; ++n) {
    for (const double zeros : {0.0, 0.4, 0.9}) {
      const std::vector<double> l = numbers(std::size_t{n} * rowLength(n), zeros, random);
      std::vector<double> expected = numbers(n, zeros, random);
      std::vector<double> b = expected;
      reference(l.data(), expected.data(), n, rowLength(n));
      ours(l.data(), b.data(), n, rowLength(n), {});
      ASSERT_EQ(bits(b), bits(expected)) << n << " unknowns";
    }
  }
}

/// As the equations of joints that stand apart: whole blocks off the diagonal are zero.
std::vector<double> withEmptyBlocks(unsigned n, double empty, Random& random) {
  const unsigned skip = rowLength(n);
  std::vector<double> result = numbers(std::size_t{n} * skip, 0.2, random);
  for (unsigned row = 0; row < n; row += 4) {
    for (unsigned column = 0; column < row; column += 4) {
      if (random.uniform() >= empty) continue;
      for (unsigned r = row; r < std::min(row + 4, n); ++r) {
        std::fill_n(result.begin() + static_cast<std::ptrdiff_t>(std::size_t{r} * skip + column), 4, 0.0);
      }
    }
  }
  return result;
}

void compareSolversWithBlocks(const char* odesName, SolveBlocks ours) {
  const auto reference = odes<Solve>(odesName);
  if (reference == nullptr) GTEST_SKIP() << "this ODE has no " << odesName;
  Random random(7);
  for (unsigned n = 1; n <= kLargest; ++n) {
    const std::vector<double> l = withEmptyBlocks(n, 0.8, random);
    // The blocks of all rows are known, or (rows were appended to a factor) only those of the first.
    for (const unsigned known : {n, n - n / 3, n / 2}) {
      kernels::Blocks blocks;
      blocks.read(l.data(), known, rowLength(n));
      std::vector<double> expected = numbers(n, 0.4, random);
      std::vector<double> b = expected;
      reference(l.data(), expected.data(), n, rowLength(n));
      ours(l.data(), b.data(), n, rowLength(n), blocks);
      ASSERT_EQ(bits(b), bits(expected)) << n << " unknowns, " << known << " rows known";
    }
  }
}

TEST(OdeKernels, ForwardSolutionWithoutEmptyBlocksIsOdesToTheBit) {
  compareSolversWithBlocks("_Z15solveL1StraightILj1EEvPKdPdjj", &kernels::solveL1);
}

TEST(OdeKernels, BackwardSolutionWithoutEmptyBlocksIsOdesToTheBit) {
  compareSolversWithBlocks("_Z17solveL1TransposedILj1EEvPKdPdjj", &kernels::solveL1Transposed);
}

TEST(OdeKernels, ListsTheBlocksThatAreNotEmpty) {
  constexpr unsigned kRows = 40;
  Random random(8);
  const std::vector<double> l = withEmptyBlocks(kRows, 0.7, random);
  kernels::Blocks blocks;
  blocks.read(l.data(), kRows + 3, rowLength(kRows));
  ASSERT_EQ(blocks.rows(), kRows);
  for (unsigned row = 0; row < kRows; row += 4) {
    for (unsigned column = 0; column < row; column += 4) {
      bool empty = true;
      for (unsigned i = 0; i < 16; ++i) {
        empty = empty && l[(row + i / 4) * std::size_t{rowLength(kRows)} + column + i % 4] == 0.0;
      }
      const auto left = blocks.left(row);
      const auto below = blocks.below(column);
      EXPECT_EQ(std::count(left.begin(), left.end(), column), empty ? 0 : 1) << row << " " << column;
      EXPECT_EQ(std::count(below.begin(), below.end(), row), empty ? 0 : 1) << row << " " << column;
    }
  }
  EXPECT_TRUE(blocks.left(kRows).empty());
}

TEST(OdeKernels, ForwardSolutionIsOdesToTheBit) {
  compareSolvers("_Z15solveL1StraightILj1EEvPKdPdjj", &kernels::solveL1);
}

TEST(OdeKernels, BackwardSolutionIsOdesToTheBit) {
  compareSolvers("_Z17solveL1TransposedILj1EEvPKdPdjj", &kernels::solveL1Transposed);
}

TEST(OdeKernels, FactorsAreOdesToTheBit) {
  const char* name = "_Z18factorMatrixAsLDLTILj1EEvPdS0_jj";
  const auto reference = odes<Factor>(name);
  if (reference == nullptr) GTEST_SKIP() << "this ODE has no " << name;
  Random random(6);
  for (unsigned n = 1; n <= kLargest; ++n) {
    for (const double zeros : {0.0, 0.4, 0.9}) {
      std::vector<double> a = zeros == 0.4 ? withEmptyBlocks(n, 0.8, random)
                                           : numbers(std::size_t{n} * rowLength(n), zeros, random);
      for (unsigned i = 0; i < n; ++i) a[i * (rowLength(n) + 1)] = n;
      std::vector<double> expected = a;
      std::vector<double> d(n);
      std::vector<double> expectedD(n);
      reference(expected.data(), expectedD.data(), n, rowLength(n));
      kernels::factorLdlt(a.data(), d.data(), n, rowLength(n));
      ASSERT_EQ(bits(d), bits(expectedD)) << n << " rows";
      for (unsigned i = 0; i < n; ++i) {
        for (unsigned k = 0; k < i; ++k) {
          const std::size_t at = i * std::size_t{rowLength(n)} + k;
          ASSERT_EQ(std::bit_cast<std::uint64_t>(a[at]), std::bit_cast<std::uint64_t>(expected[at]))
              << n << " rows, row " << i << " column " << k;
        }
      }
    }
  }
}

TEST(OdeKernels, OdeCallsThem) {
  if (odes<Factor>("_Z18factorMatrixAsLDLTILj1EEvPdS0_jj") == nullptr) GTEST_SKIP() << "not this ODE";
  const unsigned long before = kernels::callsByOde();
  nonet::sim::runFixedEpisode({}, 1, 10, false);
  EXPECT_GT(kernels::callsByOde(), before);
}

}  // namespace
