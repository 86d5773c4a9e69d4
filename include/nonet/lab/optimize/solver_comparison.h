// Whether learning on the quick stepper of ODE ranks parameter sets as the exact one does.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "nonet/lab/optimize/optimization_settings.h"

namespace nonet::lab {

/// Spearman's: Pearson's correlation of the ranks, ties get their mean rank. NaN for fewer than two values.
double rankCorrelation(const std::vector<double>& a, const std::vector<double>& b);

struct SolverComparison {
  std::vector<std::pair<double, double>> fitness;  // exact, quick; one per set
  double rankCorrelation = 0.0;
  double exactSeconds = 0.0;  // processor time per trial
  double quickSeconds = 0.0;
};

/// `sets` points around the start of the settings: normal with its sigma, each with its own spread of 0.2
/// to 1.5 sigma so that good and bad ones are among them, all on the same `settings.trials` seeds.
SolverComparison compareSolvers(const OptimizationSettings& settings, int sets, const std::string& dataFolder,
                                int threads);

}  // namespace nonet::lab
