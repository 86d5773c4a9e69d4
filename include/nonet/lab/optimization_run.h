// One optimization as a folder: config.json (what is optimized, with every seed), generations.jsonl (one line
// each), checkpoint.json (written to a new file, then renamed), best.toml (the best parameters so far with
// their provenance). A run that is killed at any point and resumed ends in the same bytes as one that was
// not.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "nonet/lab/cma_es.h"
#include "nonet/lab/evaluator.h"
#include "nonet/lab/search_space.h"
#include "nonet/lab/task.h"

namespace nonet::lab {

struct OptimizationConfig {
  std::string task;
  int robotType = 0;
  bool quickSolver = false;
  std::uint64_t seed = 1;
  int population = 0;  // 0: the default of CMA-ES
  int generations = 200;
  double sigma = 0.2;         // of the search ranges
  int trials = 4;             // seeds per candidate; all candidates of a generation get the same ones
  bool racing = false;        // the worse half of a generation gets only half of the trials
  int validationEvery = 5;    // generations between comparisons of mean, generation's best and incumbent
  int validationTrials = 16;  // fresh seeds per comparison
  RestartScheme restarts = RestartScheme::None;
  std::vector<std::string> keys;  // prefixes of the parameters to move; empty: those of the task
  std::string parameters;         // TOML overlaid on the defaults: where the search starts

  nlohmann::json toJson() const;
  static OptimizationConfig fromJson(const nlohmann::json& value);
};

struct GenerationReport {
  int generation = 0;
  double best = 0.0;  // fitness, mean over the trials, of the generation's best candidate
  double mean = 0.0;  // over the candidates
  double sigma = 0.0;
  std::int64_t evaluations = 0;  // simulated trials so far
  double incumbent = 0.0;  // validated fitness of the best parameters so far; NaN before the first validation
};

/// The trial seeds of a generation: `stream` 0 for candidates, 1 for validation.
std::vector<std::uint64_t> trialSeeds(std::uint64_t runSeed, int generation, int stream, int count);

class OptimizationRun {
 public:
  /// A new run; throws std::runtime_error if the folder holds one already.
  static OptimizationRun create(const std::string& folder, const OptimizationConfig& config,
                                const std::string& dataFolder);
  /// Continues the one in the folder. `generations` extends it.
  static OptimizationRun resume(const std::string& folder, const std::string& dataFolder,
                                std::optional<int> generations);

  /// The objective for the evaluator's workers (the same on every rank).
  Objective objective() const;
  /// One generation; false when all are done. `report` may be shown to the user.
  bool step(Evaluator& evaluator, GenerationReport& report);

  const OptimizationConfig& config() const { return config_; }
  const SearchSpace& space() const { return space_; }

 private:
  OptimizationRun(std::string folder, OptimizationConfig config, std::string dataFolder);
  Eigen::VectorXd evaluateGeneration(Evaluator& evaluator, const Eigen::MatrixXd& points);
  void validate(Evaluator& evaluator, const Eigen::VectorXd& candidate);
  void writeLine(const GenerationReport& report, const Eigen::MatrixXd& points,
                 const Eigen::VectorXd& fitness) const;
  void writeCheckpoint() const;
  void writeBest() const;

  std::string folder_;
  OptimizationConfig config_;
  std::string dataFolder_;
  agent::AgentParameters base_;
  SearchSpace space_;
  RestartingCmaEs optimizer_;
  int generation_ = 0;
  std::int64_t trialsDone_ = 0;
  // The incumbent: the best point so far by the mean over all validations that it took part in.
  Eigen::VectorXd incumbent_;
  double incumbentSum_ = 0.0;
  int incumbentTrials_ = 0;
};

/// Base parameters of a config: defaults, params/type<N>.toml, then config.parameters.
agent::AgentParameters baseParameters(const OptimizationConfig& config, const std::string& dataFolder);

/// Re-evaluates a learned file with the seeds in its provenance.
struct Repetition {
  double recorded = 0.0;
  double repeated = 0.0;
  int trials = 0;
};
Repetition repeatLearned(const std::string& file, const std::string& dataFolder, int threads);

}  // namespace nonet::lab
