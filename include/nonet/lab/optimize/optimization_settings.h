// What one optimization does: everything that decides its result, and nothing else (not the number of
// workers).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "nonet/lab/optimize/cma_es.h"
#include "nonet/lab/optimize/evaluator.h"
#include "nonet/lab/optimize/learned_file.h"
#include "nonet/lab/optimize/search_space.h"
#include "nonet/lab/tasks/task.h"

namespace nonet::lab {

struct OptimizationSettings {
  std::string task;
  int robotType = 0;
  bool quickSolver = false;
  std::uint64_t seed = 1;
  int population = 0;  // 0: the default of CMA-ES
  int generations = 200;
  double sigma = 0.1;         // of the search ranges
  int trials = 4;             // seeds per candidate; all candidates of a generation get the same ones
  bool racing = false;        // the worse half of a generation gets only half of the trials
  int validationEvery = 5;    // generations between comparisons of mean, generation's best and incumbent; the
                              // last generation has one in any case
  int validationTrials = 16;  // fresh seeds per comparison
  RestartScheme restarts = RestartScheme::None;
  std::vector<std::string> keys;  // prefixes of the parameters to move; empty: those of the task
  std::string parameters;  // TOML of all values at the start, so that later changes of defaults or files
                           // do not change the run
  std::vector<Provenance> inherited;  // of the files that `parameters` came from
  std::string date;                   // of creation, for the provenance
  std::string version;                // of the program that created it
  std::string fingerprint;  // of that program, params/ and skills/ (fingerprintOf()): what opponents and
                            // skills of the trials come from; empty: not known

  nlohmann::json toJson() const;
  /// Throws nlohmann::json::exception or std::runtime_error.
  static OptimizationSettings fromJson(const nlohmann::json& value);

  std::vector<std::string> searchedKeys() const;  // of the settings, or else of the task
  agent::AgentParameters startParameters(const std::string& dataFolder) const;
  TaskSettings taskSettings(const std::string& dataFolder) const;
};

/// The defaults of the code and of the skill files.
agent::AgentParameters defaultParameters(const std::string& dataFolder);

/// Sets `parameters` and `inherited`: defaults, then DATA/params/type<robotType>.toml if there is one, then
/// `files` in this order. Throws config::ParameterError.
void setStart(OptimizationSettings& settings, const std::string& dataFolder,
              const std::vector<std::string>& files);

/// "none", "ipop", "bipop"; throws std::runtime_error.
RestartScheme restartSchemeOf(const std::string& name);
std::string nameOf(RestartScheme scheme);

/// Fitness (higher is better) of a point of the search space of the settings: what the evaluator's workers
/// run, the same on every rank.
Objective makeObjective(const OptimizationSettings& settings, const std::string& dataFolder);

}  // namespace nonet::lab
