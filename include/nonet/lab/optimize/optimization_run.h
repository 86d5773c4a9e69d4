// One optimization as a folder: config.json (what is optimized, with every seed), generations.jsonl (one
// line each: every point, every seed, every value), checkpoint.json (written to a new file, then renamed),
// best.toml (the best parameters so far with their provenance). A run that is killed at any point and resumed
// ends in the same bytes as one that was not. So does one that is made longer: a last validation between the
// regular ones goes into best.toml only, and a longer run forgets it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "nonet/lab/optimize/optimization_settings.h"

namespace nonet::lab {

struct GenerationReport {
  int generation = 0;  // counted from 1
  double best = 0.0;   // fitness, mean over the trials, of the generation's best candidate
  double mean = 0.0;   // over the candidates
  double sigma = 0.0;
  std::int64_t trials = 0;  // simulated so far, validations included
  double incumbent = 0.0;  // validated fitness of the best parameters so far; NaN before the first validation
};

class OptimizationRun {
 public:
  /// A new run; throws std::runtime_error if the folder holds one already, another process works on it, or
  /// the settings make no search (a step size of 0, a population of 1).
  static OptimizationRun create(const std::string& folder, const OptimizationSettings& settings,
                                const std::string& dataFolder);
  /// What the run in the folder was started with. Throws std::runtime_error that names the file.
  static OptimizationSettings readSettings(const std::string& folder);
  /// Continues the one in the folder; `generations` extends it. Throws std::runtime_error.
  static OptimizationRun resume(const std::string& folder, const std::string& dataFolder,
                                std::optional<int> generations);

  /// One generation; false when all are done or CMA-ES has converged. The evaluator's objective must be
  /// makeObjective(settings(), dataFolder).
  bool step(Evaluator& evaluator, GenerationReport& report);

  const OptimizationSettings& settings() const { return settings_; }
  const SearchSpace& space() const { return space_; }
  const RestartingCmaEs& optimizer() const { return optimizer_; }
  int generation() const { return generation_; }
  std::int64_t trials() const { return trials_; }

 private:
  using Values = std::vector<std::vector<double>>;  // [candidate][trial]

  OptimizationRun(std::string folder, const OptimizationSettings& settings, std::string dataFolder);
  Values evaluate(Evaluator& evaluator, const std::vector<Eigen::VectorXd>& points,
                  const std::vector<std::uint64_t>& seeds);
  Values evaluateGeneration(Evaluator& evaluator, const Eigen::MatrixXd& points,
                            const std::vector<std::uint64_t>& seeds);
  // The best point so far, with all validations that it took part in.
  struct Incumbent {
    Eigen::VectorXd point;
    SeedList seeds;
    std::vector<double> values;
    int generation = 0;  // that it comes from
    std::int64_t budget = 0;
    int population = 0;  // of the generation that it comes from

    nlohmann::json toJson() const;
    static Incumbent fromJson(const nlohmann::json& value);
  };
  Incumbent validated(Evaluator& evaluator, const std::vector<Eigen::VectorXd>& challengers);
  void validateLast(Evaluator& evaluator, const std::vector<Eigen::VectorXd>& challengers,
                    GenerationReport& report);
  std::string line(const Eigen::MatrixXd& points, const std::vector<std::uint64_t>& seeds,
                   const Values& values, const GenerationReport& report) const;
  void appendLine(const std::string& text);
  void writeCheckpoint() const;
  void readCheckpoint();
  void restore(const nlohmann::json& state);
  void writeBest() const;
  const Incumbent& bestSoFar() const { return last_ ? *last_ : incumbent_; }
  Provenance origin() const;

  std::string folder_;
  std::shared_ptr<void> lock_;  // one process per folder: a rank that outlives mpirun would write too
  OptimizationSettings settings_;
  std::string dataFolder_;
  SearchSpace space_;
  RestartingCmaEs optimizer_;
  int generation_ = 0;  // finished ones
  std::int64_t trials_ = 0;
  std::int64_t bytes_ = 0;  // of generations.jsonl
  Incumbent incumbent_;
  std::optional<Incumbent> last_;  // who won the last validation, where that is not a regular one
};

}  // namespace nonet::lab
