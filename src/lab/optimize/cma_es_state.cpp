// Saving and restoring the optimizer. JSON numbers are written in the shortest form that reads back to the
// same bits; infinities, which JSON lacks, are written as null.
#include <cmath>
#include <limits>

#include <nlohmann/json.hpp>

#include "nonet/lab/optimize/cma_es.h"

namespace nonet::lab {

namespace {

using nlohmann::json;

json toJson(const Eigen::MatrixXd& matrix) {
  json values = json::array();
  for (Eigen::Index i = 0; i < matrix.size(); ++i) values.push_back(matrix.data()[i]);
  return {{"rows", matrix.rows()}, {"columns", matrix.cols()}, {"values", std::move(values)}};
}

Eigen::MatrixXd matrixFrom(const json& value) {
  Eigen::MatrixXd matrix(value.at("rows").get<Eigen::Index>(), value.at("columns").get<Eigen::Index>());
  const json& values = value.at("values");
  if (static_cast<Eigen::Index>(values.size()) != matrix.size())
    throw std::runtime_error("checkpoint: a matrix has the wrong number of values");
  for (Eigen::Index i = 0; i < matrix.size(); ++i)
    matrix.data()[i] = values[static_cast<std::size_t>(i)].get<double>();
  return matrix;
}

json fitnessJson(double fitness) {
  return std::isfinite(fitness) ? json(fitness) : json(nullptr);
}
double fitnessFrom(const json& value) {
  return value.is_null() ? std::numeric_limits<double>::infinity() : value.get<double>();
}

json randomJson(const Random& random) {
  return random.state();
}
void restoreRandom(const json& value, Random& random) {
  random.setState(value.get<Random::State>());
}

json settingsJson(const CmaEsSettings& settings) {
  return {{"population", settings.population},
          {"sigma", settings.sigma},
          {"active", settings.active},
          {"seed", settings.seed},
          {"low", toJson(settings.low)},
          {"high", toJson(settings.high)},
          {"leastStep", settings.leastStep},
          {"startLow", toJson(settings.startLow)},
          {"startHigh", toJson(settings.startHigh)}};
}

CmaEsSettings settingsFrom(const json& value) {
  CmaEsSettings settings;
  settings.population = value.at("population").get<int>();
  settings.sigma = value.at("sigma").get<double>();
  settings.active = value.at("active").get<bool>();
  settings.seed = value.at("seed").get<std::uint64_t>();
  settings.low = matrixFrom(value.at("low"));
  settings.high = matrixFrom(value.at("high"));
  if (!value.contains("leastStep")) return settings;  // begun before there was one
  settings.leastStep = value.at("leastStep").get<double>();
  settings.startLow = matrixFrom(value.at("startLow"));
  settings.startHigh = matrixFrom(value.at("startHigh"));
  return settings;
}

}  // namespace

json CmaEs::save() const {
  json recent = json::array();
  for (const double value : recentBest_) recent.push_back(fitnessJson(value));
  return {{"settings", settingsJson(settings_)},
          {"population", population_},
          {"mean", toJson(mean_)},
          {"sigma", sigma_},
          {"covariance", toJson(covariance_)},
          {"basis", toJson(basis_)},
          {"scales", toJson(scales_)},
          {"path", toJson(path_)},
          {"sigmaPath", toJson(sigmaPath_)},
          {"samples", toJson(samples_)},
          {"asked", asked_},
          {"generation", generation_},
          {"decomposedAt", decomposedAt_},
          {"evaluations", evaluations_},
          {"best", toJson(best_)},
          {"bestFitness", fitnessJson(bestFitness_)},
          {"recentBest", std::move(recent)},
          {"stop", static_cast<int>(stop_)},
          {"random", randomJson(random_)}};
}

CmaEs CmaEs::restore(const json& state) {
  CmaEs run;
  run.settings_ = settingsFrom(state.at("settings"));
  run.population_ = state.at("population").get<int>();
  run.mean_ = matrixFrom(state.at("mean"));
  run.sigma_ = state.at("sigma").get<double>();
  run.covariance_ = matrixFrom(state.at("covariance"));
  run.basis_ = matrixFrom(state.at("basis"));
  run.scales_ = matrixFrom(state.at("scales"));
  run.path_ = matrixFrom(state.at("path"));
  run.sigmaPath_ = matrixFrom(state.at("sigmaPath"));
  run.samples_ = matrixFrom(state.at("samples"));
  run.asked_ = state.at("asked").get<bool>();
  run.generation_ = state.at("generation").get<int>();
  run.decomposedAt_ = state.at("decomposedAt").get<int>();
  run.evaluations_ = state.at("evaluations").get<std::int64_t>();
  run.best_ = matrixFrom(state.at("best"));
  run.bestFitness_ = fitnessFrom(state.at("bestFitness"));
  for (const json& value : state.at("recentBest")) run.recentBest_.push_back(fitnessFrom(value));
  run.stop_ = static_cast<CmaEsStop>(state.at("stop").get<int>());
  restoreRandom(state.at("random"), run.random_);
  run.setWeights();
  run.inBox_.resize(run.samples_.rows(), run.samples_.cols());
  for (Eigen::Index k = 0; k < run.samples_.cols(); ++k) run.inBox_.col(k) = run.intoBox(run.samples_.col(k));
  return run;
}

json RestartingCmaEs::save() const {
  return {{"start", toJson(start_)},
          {"settings", settingsJson(settings_)},
          {"scheme", static_cast<int>(scheme_)},
          {"run", run_.save()},
          {"random", randomJson(random_)},
          {"restarts", restarts_},
          {"largePopulation", largePopulation_},
          {"smallRegime", smallRegime_},
          {"largeBudget", largeBudget_},
          {"smallBudget", smallBudget_},
          {"finishedEvaluations", finishedEvaluations_},
          {"best", toJson(best_)},
          {"bestFitness", fitnessJson(bestFitness_)}};
}

RestartingCmaEs RestartingCmaEs::restore(const json& state) {
  RestartingCmaEs optimizer(CmaEs::restore(state.at("run")));
  optimizer.start_ = matrixFrom(state.at("start"));
  optimizer.settings_ = settingsFrom(state.at("settings"));
  optimizer.scheme_ = static_cast<RestartScheme>(state.at("scheme").get<int>());
  restoreRandom(state.at("random"), optimizer.random_);
  optimizer.restarts_ = state.at("restarts").get<int>();
  optimizer.largePopulation_ = state.at("largePopulation").get<int>();
  optimizer.smallRegime_ = state.at("smallRegime").get<bool>();
  optimizer.largeBudget_ = state.at("largeBudget").get<std::int64_t>();
  optimizer.smallBudget_ = state.at("smallBudget").get<std::int64_t>();
  optimizer.finishedEvaluations_ = state.at("finishedEvaluations").get<std::int64_t>();
  optimizer.best_ = matrixFrom(state.at("best"));
  optimizer.bestFitness_ = fitnessFrom(state.at("bestFitness"));
  return optimizer;
}

}  // namespace nonet::lab
