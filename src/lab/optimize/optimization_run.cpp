#include "nonet/lab/optimize/optimization_run.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "nonet/lab/common/atomic_file.h"
#include "nonet/lab/common/folder_lock.h"
#include "nonet/lab/common/statistics.h"

namespace nonet::lab {

using nlohmann::json;
namespace fs = std::filesystem;

namespace {

constexpr const char* kConfig = "/config.json";
constexpr const char* kGenerations = "/generations.jsonl";
constexpr const char* kCheckpoint = "/checkpoint.json";
constexpr const char* kBest = "/best.toml";

json vectorJson(const Eigen::VectorXd& vector) {
  return std::vector<double>(vector.begin(), vector.end());
}

Eigen::VectorXd vectorFrom(const json& value) {
  const auto values = value.get<std::vector<double>>();
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

json readJson(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(fmt::format("cannot read {}: is this the folder of a run?", path));
  try {
    return json::parse(file);
  } catch (const json::exception& error) {
    throw std::runtime_error(fmt::format("{}: is damaged: {}", path, error.what()));
  }
}

/// What cannot make a search. Throws std::runtime_error.
const OptimizationSettings& checked(const OptimizationSettings& settings) {
  const auto demand = [](bool holds, const char* what, double value) {
    if (!holds) throw std::runtime_error(fmt::format("{}, not {}", what, value));
  };
  constexpr int kSmallestPopulation = 4;  // below it CMA-ES has too few to choose from
  demand(settings.generations >= 1, "generations must be 1 or more", settings.generations);
  demand(settings.sigma > 0.0 && settings.sigma <= 1.0,
         "sigma, a share of the search ranges, must be above 0 and at most 1", settings.sigma);
  demand(settings.population == 0 || settings.population >= kSmallestPopulation,
         "the population must be 4 or more, or 0 for CMA-ES' default", settings.population);
  demand(settings.trials >= 1, "trials must be 1 or more", settings.trials);
  demand(settings.validationTrials >= 2, "validation trials must be 2 or more: one has no standard error",
         settings.validationTrials);
  demand(settings.validationEvery >= 1, "generations between validations must be 1 or more",
         settings.validationEvery);
  return settings;
}

// With such small steps (shares of the first) candidates differ by less than trials of one do.
constexpr double kLeastStep = 1e-3;

CmaEsSettings cmaSettings(const OptimizationSettings& settings, const SearchSpace& space) {
  return {.population = settings.population,
          .sigma = settings.sigma,
          .active = true,
          .seed = settings.seed,
          .low = space.low(),
          .high = space.high(),
          .leastStep = kLeastStep,
          .startLow = Eigen::VectorXd::Zero(space.dimension()),
          .startHigh = Eigen::VectorXd::Ones(space.dimension())};
}

// Fitness of a generation for ranking. In a race, candidates with fewer trials stay below all with more:
// their means are over other seeds and cannot be compared.
Eigen::VectorXd rankingFitness(const std::vector<std::vector<double>>& values, std::size_t trials) {
  Eigen::VectorXd fitness(static_cast<Eigen::Index>(values.size()));
  double worstFull = std::numeric_limits<double>::infinity();
  double bestShort = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < values.size(); ++k) {
    const double value = mean(values[k]);
    fitness[static_cast<Eigen::Index>(k)] = value;
    if (values[k].size() == trials) {
      worstFull = std::min(worstFull, value);
    } else {
      bestShort = std::max(bestShort, value);
    }
  }
  const double shift = std::min(0.0, worstFull - bestShort);
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (values[k].size() < trials) fitness[static_cast<Eigen::Index>(k)] += shift;
  }
  return fitness;
}

}  // namespace

OptimizationRun::OptimizationRun(std::string folder, const OptimizationSettings& settings,
                                 std::string dataFolder)
    : folder_(std::move(folder)),
      settings_(checked(settings)),
      dataFolder_(std::move(dataFolder)),
      space_(settings.startParameters(dataFolder_), settings.searchedKeys()),
      optimizer_(space_.start(), cmaSettings(settings, space_), settings.restarts) {
  incumbent_.point = space_.start();
  incumbent_.population = optimizer_.run().population();
}

OptimizationSettings OptimizationRun::readSettings(const std::string& folder) {
  const std::string path = folder + kConfig;
  try {
    return OptimizationSettings::fromJson(readJson(path));
  } catch (const json::exception& error) {
    throw std::runtime_error(fmt::format("{}: is damaged: {}", path, error.what()));
  }
}

OptimizationRun OptimizationRun::create(const std::string& folder, const OptimizationSettings& settings,
                                        const std::string& dataFolder) {
  if (fs::exists(folder + kConfig)) {
    throw std::runtime_error(
        fmt::format("{} holds a run already: continue it with --resume or choose another folder", folder));
  }
  OptimizationRun run(folder, settings, dataFolder);
  makeFolder(folder);
  run.lock_ = lockFolder(folder);
  fs::remove(folder + kCheckpoint);
  std::ofstream generations(folder + kGenerations, std::ios::binary | std::ios::trunc);
  generations.close();
  writeAtomically(folder + kConfig, settings.toJson().dump(1) + "\n");
  return run;
}

OptimizationRun OptimizationRun::resume(const std::string& folder, const std::string& dataFolder,
                                        std::optional<int> generations) {
  OptimizationSettings settings = readSettings(folder);
  const std::shared_ptr<void> lock = lockFolder(folder);
  const bool extended = generations && *generations != settings.generations;
  if (extended) settings.generations = *generations;
  OptimizationRun run(folder, settings, dataFolder);
  run.lock_ = lock;
  // Killed before the first checkpoint: from the beginning.
  if (fs::exists(folder + kCheckpoint)) run.readCheckpoint();
  if (settings.generations < run.generation())
    throw std::runtime_error(fmt::format("{} has {} generations already: --generations cannot take any back",
                                         folder, run.generation()));
  const std::string lines = folder + kGenerations;
  if (!fs::exists(lines) || static_cast<std::int64_t>(fs::file_size(lines)) < run.bytes_)
    throw std::runtime_error(
        fmt::format("{} is shorter than its checkpoint says; the run is damaged", lines));
  // Nothing is written before all is found well: a refused run can be resumed as it was.
  if (extended) writeAtomically(folder + kConfig, settings.toJson().dump(1) + "\n");
  fs::resize_file(lines, static_cast<std::uintmax_t>(run.bytes_));
  if (run.incumbent_.seeds.size() == 0) {
    fs::remove(folder + kBest);
  } else {
    run.writeBest();
  }
  return run;
}

OptimizationRun::Values OptimizationRun::evaluate(Evaluator& evaluator,
                                                  const std::vector<Eigen::VectorXd>& points,
                                                  const std::vector<std::uint64_t>& seeds) {
  std::vector<Job> jobs;
  for (const Eigen::VectorXd& point : points) {
    for (const std::uint64_t seed : seeds) jobs.push_back({point, seed});
  }
  const std::vector<double> flat = evaluator.evaluate(jobs);
  trials_ += static_cast<std::int64_t>(jobs.size());
  Values values;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto begin = flat.begin() + static_cast<std::ptrdiff_t>(k * seeds.size());
    values.emplace_back(begin, begin + static_cast<std::ptrdiff_t>(seeds.size()));
  }
  return values;
}

// All candidates get the same seeds (common random numbers). In a race the better half of the first half of
// the trials goes on.
OptimizationRun::Values OptimizationRun::evaluateGeneration(Evaluator& evaluator,
                                                            const Eigen::MatrixXd& points,
                                                            const std::vector<std::uint64_t>& seeds) {
  std::vector<Eigen::VectorXd> all;
  for (Eigen::Index k = 0; k < points.cols(); ++k) all.emplace_back(points.col(k));
  if (!settings_.racing || seeds.size() < 2) return evaluate(evaluator, all, seeds);

  const auto half = static_cast<std::ptrdiff_t>((seeds.size() + 1) / 2);
  Values values = evaluate(evaluator, all, {seeds.begin(), seeds.begin() + half});
  std::vector<std::size_t> order(all.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return mean(values[a]) > mean(values[b]); });
  order.resize((order.size() + 1) / 2);
  std::vector<Eigen::VectorXd> better;
  better.reserve(order.size());
  for (const std::size_t k : order) better.push_back(all[k]);
  const Values more = evaluate(evaluator, better, {seeds.begin() + half, seeds.end()});
  for (std::size_t i = 0; i < order.size(); ++i)
    values[order[i]].insert(values[order[i]].end(), more[i].begin(), more[i].end());
  return values;
}

// Fresh seeds, the same for all, and a challenger must win by more than the standard error of the paired
// difference: the best of many noisy values is mostly luck.
OptimizationRun::Incumbent OptimizationRun::validated(Evaluator& evaluator,
                                                      const std::vector<Eigen::VectorXd>& challengers) {
  const auto seeds =
      trialSeeds(settings_.seed, generation_, SeedStream::Validation, settings_.validationTrials);
  const SeedDraw draw{settings_.seed, generation_, settings_.validationTrials};
  std::vector<Eigen::VectorXd> points{incumbent_.point};
  points.insert(points.end(), challengers.begin(), challengers.end());
  const Values values = evaluate(evaluator, points, seeds);
  std::size_t winner = 0;
  for (std::size_t k = 1; k < points.size(); ++k) {
    std::vector<double> gain(seeds.size());
    for (std::size_t i = 0; i < seeds.size(); ++i) gain[i] = values[k][i] - values[winner][i];
    if (mean(gain) > standardError(gain)) winner = k;
  }
  Incumbent best = incumbent_;
  if (winner != 0) best = {points[winner], {}, {}, generation_, trials_, optimizer_.run().population()};
  best.seeds.add(draw);
  best.values.insert(best.values.end(), values[winner].begin(), values[winner].end());
  return best;
}

// A longer run has no validation here: what it will go on from, its trials included, stays as it is.
void OptimizationRun::validateLast(Evaluator& evaluator, const std::vector<Eigen::VectorXd>& challengers,
                                   GenerationReport& report) {
  const std::int64_t trials = trials_;
  last_ = validated(evaluator, challengers);
  report.trials = std::exchange(trials_, trials);
  report.incumbent = mean(last_->values);
}

bool OptimizationRun::step(Evaluator& evaluator, GenerationReport& report) {
  if (generation_ >= settings_.generations || optimizer_.finished()) return false;
  const Eigen::MatrixXd points = optimizer_.ask();
  const auto seeds = trialSeeds(settings_.seed, generation_ + 1, SeedStream::Candidates, settings_.trials);
  const Values values = evaluateGeneration(evaluator, points, seeds);
  const Eigen::VectorXd fitness = rankingFitness(values, seeds.size());
  optimizer_.tell(-fitness);  // it minimises
  ++generation_;

  Eigen::Index best = 0;
  report.best = fitness.maxCoeff(&best);
  const std::vector<Eigen::VectorXd> challengers{optimizer_.run().meanInBox(), points.col(best)};
  const bool due = generation_ == 1 || generation_ % settings_.validationEvery == 0 || optimizer_.finished();
  if (due) incumbent_ = validated(evaluator, challengers);

  report.generation = generation_;
  report.mean = 0.0;
  for (const auto& candidate : values) report.mean += mean(candidate) / static_cast<double>(values.size());
  report.sigma = optimizer_.run().sigma();
  report.trials = trials_;
  report.incumbent =
      incumbent_.values.empty() ? std::numeric_limits<double>::quiet_NaN() : mean(incumbent_.values);
  appendLine(line(points, seeds, values, report));
  if (!due && generation_ == settings_.generations) validateLast(evaluator, challengers, report);
  writeBest();
  writeCheckpoint();
  return true;
}

std::string OptimizationRun::line(const Eigen::MatrixXd& points, const std::vector<std::uint64_t>& seeds,
                                  const Values& values, const GenerationReport& report) const {
  json candidates = json::array();
  for (std::size_t k = 0; k < values.size(); ++k) {
    candidates.push_back(
        {{"point", vectorJson(points.col(static_cast<Eigen::Index>(k)))}, {"values", values[k]}});
  }
  const CmaEs& run = optimizer_.run();
  const json whole = {{"generation", report.generation},
                      {"best", report.best},
                      {"mean", report.mean},
                      {"sigma", report.sigma},
                      {"trials", report.trials},
                      {"restarts", optimizer_.restarts()},
                      {"centre", vectorJson(run.meanInBox())},
                      {"deviations", vectorJson(run.deviations())},
                      {"seeds", seeds},
                      {"candidates", std::move(candidates)},
                      {"incumbent", report.incumbent},
                      {"incumbentError", standardError(incumbent_.values)},
                      {"incumbentGeneration", incumbent_.generation},
                      {"incumbentTrials", incumbent_.values.size()}};
  return whole.dump() + "\n";
}

void OptimizationRun::appendLine(const std::string& text) {
  std::ofstream file(folder_ + kGenerations, std::ios::binary | std::ios::app);
  file << text;
  file.flush();
  if (!file) throw std::runtime_error(fmt::format("cannot write {}{}", folder_, kGenerations));
  bytes_ += static_cast<std::int64_t>(text.size());
}

json OptimizationRun::Incumbent::toJson() const {
  return {{"point", vectorJson(point)}, {"seeds", seeds.toJson()}, {"values", values},
          {"generation", generation},   {"budget", budget},        {"population", population}};
}

OptimizationRun::Incumbent OptimizationRun::Incumbent::fromJson(const json& value) {
  Incumbent incumbent;
  incumbent.point = vectorFrom(value.at("point"));
  incumbent.seeds = SeedList::fromJson(value.at("seeds"));
  value.at("values").get_to(incumbent.values);
  value.at("generation").get_to(incumbent.generation);
  value.at("budget").get_to(incumbent.budget);
  incumbent.population = value.value("population", 0);
  return incumbent;
}

void OptimizationRun::writeCheckpoint() const {
  json state = {{"generation", generation_},
                {"trials", trials_},
                {"bytes", bytes_},
                {"optimizer", optimizer_.save()},
                {"incumbent", incumbent_.toJson()}};
  if (last_) state["last"] = last_->toJson();
  writeAtomically(folder_ + kCheckpoint, state.dump() + "\n");
}

void OptimizationRun::readCheckpoint() {
  const std::string path = folder_ + kCheckpoint;
  try {
    restore(readJson(path));
  } catch (const json::exception& error) {
    throw std::runtime_error(fmt::format("{}: is damaged: {}", path, error.what()));
  }
  if (bestSoFar().point.size() != space_.dimension() || incumbent_.point.size() != space_.dimension() ||
      optimizer_.run().dimension() != space_.dimension())
    throw std::runtime_error(
        fmt::format("{}: the declared parameters have changed since the run began; start a new one", path));
}

void OptimizationRun::restore(const json& state) {
  state.at("generation").get_to(generation_);
  state.at("trials").get_to(trials_);
  state.at("bytes").get_to(bytes_);
  optimizer_ = RestartingCmaEs::restore(state.at("optimizer"));
  incumbent_ = Incumbent::fromJson(state.at("incumbent"));
  // Checkpoints of before it was written down.
  if (incumbent_.population == 0) incumbent_.population = optimizer_.run().population();
  last_.reset();
  if (generation_ >= settings_.generations && state.contains("last"))
    last_ = Incumbent::fromJson(state.at("last"));
}

Provenance OptimizationRun::origin() const {
  const Incumbent& best = bestSoFar();
  return {.task = settings_.task,
          .robotType = settings_.robotType,
          .quickSolver = settings_.quickSolver,
          .runSeed = settings_.seed,
          .population = best.population,
          .generation = best.generation,
          .budget = best.budget,
          .fitness = mean(best.values),
          .standardError = standardError(best.values),
          .seeds = best.seeds,
          .date = settings_.date,
          .version = settings_.version};
}

void OptimizationRun::writeBest() const {
  std::vector<Provenance> origins = settings_.inherited;
  replaceProvenance(origins, origin());
  writeAtomically(folder_ + kBest, learnedToml(space_.apply(bestSoFar().point),
                                               defaultParameters(dataFolder_), space_.keys(), origins));
}

}  // namespace nonet::lab
