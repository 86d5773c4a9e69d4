#include "nonet/lab/optimize/solver_comparison.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <numeric>

#include "nonet/math/random.h"

namespace nonet::lab {

namespace {

std::vector<double> ranksOf(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::vector<double> ranks(values.size());
  for (std::size_t i = 0; i < order.size();) {
    std::size_t end = i + 1;
    while (end < order.size() && values[order[end]] == values[order[i]]) ++end;
    const double rank = 0.5 * static_cast<double>(i + end - 1);
    for (; i < end; ++i) ranks[order[i]] = rank;
  }
  return ranks;
}

// Of this process, all threads: other programs on the machine do not count.
double processorSeconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

}  // namespace

double rankCorrelation(const std::vector<double>& a, const std::vector<double>& b) {
  const std::vector<double> x = ranksOf(a);
  const std::vector<double> y = ranksOf(b);
  const double middle = 0.5 * (static_cast<double>(x.size()) - 1.0);
  double xy = 0.0;
  double xx = 0.0;
  double yy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xy += (x[i] - middle) * (y[i] - middle);
    xx += (x[i] - middle) * (x[i] - middle);
    yy += (y[i] - middle) * (y[i] - middle);
  }
  return xy / std::sqrt(xx * yy);
}

SolverComparison compareSolvers(const OptimizationSettings& settings, int sets, const std::string& dataFolder,
                                int threads) {
  const SearchSpace space(settings.startParameters(dataFolder), settings.searchedKeys());
  Random random = Random(settings.seed).fork(3);
  const auto seeds = trialSeeds(settings.seed, 0, SeedStream::Candidates, settings.trials);
  std::vector<Job> jobs;
  for (int k = 0; k < sets; ++k) {
    const double spread = settings.sigma * random.uniform(0.2, 1.5);
    Eigen::VectorXd point = space.start();
    for (Eigen::Index i = 0; i < point.size(); ++i) point[i] += spread * random.normal();
    point = point.cwiseMax(space.low()).cwiseMin(space.high());
    for (const std::uint64_t seed : seeds) jobs.push_back({point, seed});
  }
  const auto evaluate = [&](bool quick, double& secondsPerTrial) {
    OptimizationSettings with = settings;
    with.quickSolver = quick;
    const auto evaluator = makeThreadEvaluator(makeObjective(with, dataFolder), threads);
    const double before = processorSeconds();
    const std::vector<double> values = evaluator->evaluate(jobs);
    secondsPerTrial = (processorSeconds() - before) / static_cast<double>(jobs.size());
    std::vector<double> means;
    for (std::size_t begin = 0; begin < values.size(); begin += seeds.size()) {
      const auto first = values.begin() + static_cast<std::ptrdiff_t>(begin);
      means.push_back(std::accumulate(first, first + settings.trials, 0.0) / settings.trials);
    }
    return means;
  };
  SolverComparison comparison;
  const std::vector<double> exact = evaluate(false, comparison.exactSeconds);
  const std::vector<double> quick = evaluate(true, comparison.quickSeconds);
  for (std::size_t k = 0; k < exact.size(); ++k) comparison.fitness.emplace_back(exact[k], quick[k]);
  comparison.rankCorrelation = rankCorrelation(exact, quick);
  return comparison;
}

}  // namespace nonet::lab
