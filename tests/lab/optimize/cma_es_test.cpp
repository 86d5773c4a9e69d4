// Oracles: the analytic minima of the standard functions, and the CMA-ES of pagmo in the same run.
#include "nonet/lab/optimize/cma_es.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <pagmo/algorithms/cmaes.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>

#include "nonet/math/types.h"

namespace nonet::lab {
namespace {

double sphere(const double* x, int n) {
  double sum = 0;
  for (int i = 0; i < n; ++i) sum += x[i] * x[i];
  return sum;
}
double ellipsoid(const double* x, int n) {
  double sum = 0;
  for (int i = 0; i < n; ++i) sum += std::pow(1e6, i / (n - 1.0)) * x[i] * x[i];
  return sum;
}
double rosenbrock(const double* x, int n) {
  double sum = 0;
  for (int i = 0; i + 1 < n; ++i)
    sum += 100.0 * std::pow(x[i + 1] - x[i] * x[i], 2) + std::pow(1.0 - x[i], 2);
  return sum;
}
double rastrigin(const double* x, int n) {
  double sum = 10.0 * n;
  for (int i = 0; i < n; ++i) sum += x[i] * x[i] - 10.0 * std::cos(2.0 * kPi * x[i]);
  return sum;
}

struct Case {
  const char* name;
  double (*function)(const double*, int);
  int dimension;
  int population;  // 0: the default of 4 + 3 ln n
  double start;    // every coordinate
  double sigma;
  std::int64_t budget;
  int seeds;  // an odd number; pagmo takes seconds for the hard ones in 40 dimensions
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.name << c.dimension;
}

// Evaluations until the best value is below 1e-8; the budget if it never is.
std::int64_t ours(const Case& c, std::uint64_t seed) {
  CmaEsSettings settings;
  settings.population = c.population;
  settings.sigma = c.sigma;
  settings.seed = seed;
  CmaEs optimizer(Eigen::VectorXd::Constant(c.dimension, c.start), settings);
  Eigen::VectorXd fitness(optimizer.population());
  while (optimizer.evaluations() < c.budget && optimizer.bestFitness() > 1e-8 &&
         optimizer.stop() == CmaEsStop::None) {
    const Eigen::MatrixXd& points = optimizer.ask();
    for (int k = 0; k < fitness.size(); ++k) fitness[k] = c.function(points.col(k).data(), c.dimension);
    optimizer.tell(fitness);
  }
  return optimizer.bestFitness() <= 1e-8 ? optimizer.evaluations() : c.budget;
}

struct PagmoProblem {
  double (*function)(const double*, int) = nullptr;
  int dimension = 1;
  pagmo::vector_double fitness(const pagmo::vector_double& x) const {
    return {function(x.data(), dimension)};
  }
  std::pair<pagmo::vector_double, pagmo::vector_double> get_bounds() const {
    return {pagmo::vector_double(static_cast<std::size_t>(dimension), -10.0),
            pagmo::vector_double(static_cast<std::size_t>(dimension), 10.0)};
  }
};

std::int64_t pagmos(const Case& c, std::uint64_t seed, int population) {
  // Same start and step size. pagmo takes its first population as given (its spread is the initial step) and
  // the step sigma0 relative to the box when memory is off, so sigma is passed as it is and the box is not
  // enforced.
  pagmo::problem problem{PagmoProblem{c.function, c.dimension}};
  pagmo::population people(problem, 0, static_cast<unsigned>(seed));
  Random random(seed);
  for (int k = 0; k < population; ++k) {
    pagmo::vector_double x(static_cast<std::size_t>(c.dimension));
    for (auto& value : x) value = c.start + c.sigma * random.normal();
    people.push_back(x);
  }
  pagmo::cmaes algorithm(1, -1, -1, -1, -1, c.sigma, 1e-30, 1e-30, true, false, static_cast<unsigned>(seed));
  while (static_cast<std::int64_t>(people.get_problem().get_fevals()) < c.budget &&
         people.champion_f()[0] > 1e-8)
    people = algorithm.evolve(people);
  return people.champion_f()[0] <= 1e-8 ? static_cast<std::int64_t>(people.get_problem().get_fevals())
                                        : c.budget;
}

class AgainstPagmo : public testing::TestWithParam<Case> {};

TEST_P(AgainstPagmo, NeedsAtMostAFifthMoreEvaluations) {
  const Case& c = GetParam();
  std::vector<std::int64_t> mine;
  std::vector<std::int64_t> theirs;
  const int population = c.population > 0 ? c.population : 4 + static_cast<int>(3.0 * std::log(c.dimension));
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(c.seeds); ++seed) {
    mine.push_back(ours(c, seed));
    theirs.push_back(pagmos(c, seed, population));
  }
  std::sort(mine.begin(), mine.end());
  std::sort(theirs.begin(), theirs.end());
  const auto mineMedian = mine[mine.size() / 2];
  const auto theirMedian = theirs[theirs.size() / 2];
  fmt::print("{} in {} dimensions: median {} evaluations, pagmo {} (ratio {:.2f})\n", c.name, c.dimension,
             mineMedian, theirMedian, static_cast<double>(mineMedian) / static_cast<double>(theirMedian));
  EXPECT_LT(mineMedian, c.budget) << "not solved";
  EXPECT_LE(static_cast<double>(mineMedian), 1.2 * static_cast<double>(theirMedian));
}

INSTANTIATE_TEST_SUITE_P(Standard, AgainstPagmo,
                         testing::Values(Case{"sphere", sphere, 10, 0, 1.0, 0.5, 100000, 3},
                                         Case{"sphere", sphere, 40, 0, 1.0, 0.5, 100000, 3},
                                         Case{"ellipsoid", ellipsoid, 10, 0, 1.0, 0.5, 200000, 3},
                                         Case{"ellipsoid", ellipsoid, 40, 0, 1.0, 0.5, 400000, 1},
                                         Case{"rosenbrock", rosenbrock, 10, 0, 0.0, 0.3, 200000, 3},
                                         Case{"rosenbrock", rosenbrock, 40, 0, 0.0, 0.3, 600000, 1},
                                         Case{"rastrigin", rastrigin, 10, 600, 2.0, 2.0, 400000, 3},
                                         Case{"rastrigin", rastrigin, 40, 2000, 2.0, 2.0, 1500000, 1}));

TEST(CmaEs, ContinuesFromItsCheckpointToTheLastBit) {
  CmaEsSettings settings;
  settings.seed = 5;
  settings.low = Eigen::VectorXd::Constant(6, -1.0);
  settings.high = Eigen::VectorXd::Constant(6, 3.0);
  RestartingCmaEs whole(Eigen::VectorXd::Constant(6, 0.5), settings, RestartScheme::Bipop);
  const auto generation = [](RestartingCmaEs& optimizer) {
    const Eigen::MatrixXd points = optimizer.ask();
    Eigen::VectorXd fitness(points.cols());
    for (Eigen::Index k = 0; k < points.cols(); ++k) fitness[k] = rastrigin(points.col(k).data(), 6);
    optimizer.tell(fitness);
  };
  for (int i = 0; i < 900; ++i) {
    if (i % 37 == 0) {
      // Also between ask and tell.
      if (i % 2 == 0) whole.ask();
      whole = RestartingCmaEs::restore(nlohmann::json::parse(whole.save().dump()));
    }
    generation(whole);
  }
  RestartingCmaEs straight(Eigen::VectorXd::Constant(6, 0.5), settings, RestartScheme::Bipop);
  for (int i = 0; i < 900; ++i) generation(straight);
  EXPECT_GT(straight.restarts(), 0);
  EXPECT_EQ(whole.save().dump(), straight.save().dump());
}

// Who looks at a run between two generations sees what the last one led to, not the start of the next.
TEST(CmaEs, ARunThatEndedIsThereUntilTheNextIsAsked) {
  CmaEsSettings settings;
  settings.low = Eigen::VectorXd::Constant(3, -5.0);
  settings.high = Eigen::VectorXd::Constant(3, 5.0);
  RestartingCmaEs optimizer(Eigen::VectorXd::Constant(3, 4.0), settings, RestartScheme::Ipop);
  const int population = optimizer.run().population();
  for (int i = 0; i < 2000 && optimizer.run().stop() == CmaEsStop::None; ++i) {
    const Eigen::MatrixXd points = optimizer.ask();
    Eigen::VectorXd fitness(points.cols());
    for (Eigen::Index k = 0; k < points.cols(); ++k) fitness[k] = sphere(points.col(k).data(), 3);
    optimizer.tell(fitness);
  }
  ASSERT_NE(optimizer.run().stop(), CmaEsStop::None);
  EXPECT_EQ(optimizer.restarts(), 0);
  EXPECT_EQ(optimizer.run().population(), population);
  EXPECT_LT(optimizer.run().meanInBox().norm(), 1e-3);
  const std::int64_t evaluations = optimizer.evaluations();
  optimizer = RestartingCmaEs::restore(nlohmann::json::parse(optimizer.save().dump()));
  EXPECT_EQ(optimizer.ask().cols(), 2 * population);
  EXPECT_EQ(optimizer.restarts(), 1);
  EXPECT_EQ(optimizer.evaluations(), evaluations);
}

TEST(CmaEs, KeepsSamplesInTheBoxAndFindsAnOptimumOnItsBorder) {
  CmaEsSettings settings;
  settings.low = Eigen::VectorXd::Constant(5, 1.0);
  settings.high = Eigen::VectorXd::Constant(5, 4.0);
  CmaEs optimizer(Eigen::VectorXd::Constant(5, 3.0), settings);
  for (int i = 0; i < 150; ++i) {
    const Eigen::MatrixXd points = optimizer.ask();
    ASSERT_GE(points.minCoeff(), 1.0);
    ASSERT_LE(points.maxCoeff(), 4.0);
    Eigen::VectorXd fitness(points.cols());
    for (Eigen::Index k = 0; k < points.cols(); ++k) fitness[k] = sphere(points.col(k).data(), 5);
    optimizer.tell(fitness);
  }
  EXPECT_NEAR(optimizer.bestFitness(), 5.0, 1e-6);  // at (1, 1, 1, 1, 1)
}

TEST(CmaEs, TreatsNotANumberAsTheWorst) {
  CmaEs optimizer(Eigen::VectorXd::Constant(4, 2.0), {});
  for (int i = 0; i < 300; ++i) {
    const Eigen::MatrixXd points = optimizer.ask();
    Eigen::VectorXd fitness(points.cols());
    for (Eigen::Index k = 0; k < points.cols(); ++k)
      fitness[k] = points(0, k) < 0.0 ? std::nan("") : sphere(points.col(k).data(), 4);
    optimizer.tell(fitness);
  }
  EXPECT_LT(optimizer.bestFitness(), 1e-6);
}

TEST(CmaEs, BipopFindsTheGlobalMinimumOfRastrigin) {
  CmaEsSettings settings;
  settings.seed = 3;
  settings.sigma = 2.0;
  settings.low = Eigen::VectorXd::Constant(5, -5.0);
  settings.high = Eigen::VectorXd::Constant(5, 5.0);
  for (const RestartScheme scheme : {RestartScheme::Ipop, RestartScheme::Bipop}) {
    RestartingCmaEs optimizer(Eigen::VectorXd::Constant(5, 3.0), settings, scheme);
    while (optimizer.evaluations() < 200000 && optimizer.bestFitness() > 1e-8) {
      const Eigen::MatrixXd points = optimizer.ask();
      Eigen::VectorXd fitness(points.cols());
      for (Eigen::Index k = 0; k < points.cols(); ++k) fitness[k] = rastrigin(points.col(k).data(), 5);
      optimizer.tell(fitness);
    }
    EXPECT_LE(optimizer.bestFitness(), 1e-8);
  }
}

}  // namespace
}  // namespace nonet::lab
