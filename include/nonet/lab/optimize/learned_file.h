// Parameter files that were learned: first a table of what was reached, then the values, and at the end, in
// [provenance.<task>], where they come from, precisely enough to measure the fitness again.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "nonet/agent/parameters.h"
#include "nonet/lab/optimize/evaluator.h"
#include "nonet/lab/optimize/seed_list.h"
#include "nonet/lab/tasks/task.h"

namespace nonet::lab {

struct Provenance {
  std::string task;
  int robotType = 0;
  bool quickSolver = false;
  std::uint64_t runSeed = 0;
  int population = 0;
  int generation = 0;          // in which these values were found
  std::int64_t budget = 0;     // simulated trials until then
  double fitness = 0.0;        // mean over `seeds`
  double standardError = 0.0;  // NaN for fewer than two
  SeedList seeds;
  std::string date;
  std::string version;

  nlohmann::json toJson() const;
  static Provenance fromJson(const nlohmann::json& value);
};

/// All entries of a file, in its order. Throws std::runtime_error if the file cannot be read.
std::vector<Provenance> readProvenance(const std::string& path);

/// TOML of the values and their origin: whole tables for those that hold a searched key (so that a later
/// change of a default does not change a learned set), other values where they differ from
/// `defaults`.
std::string learnedToml(const agent::AgentParameters& parameters, const agent::AgentParameters& defaults,
                        const std::vector<std::string>& searchedKeys, const std::vector<Provenance>& origins);

/// `origin` into the list in place of an older one of the same task.
void replaceProvenance(std::vector<Provenance>& list, const Provenance& origin);

/// Fitness and named measures, means over the seeds.
struct Measurement {
  double fitness = 0.0;
  double standardError = 0.0;  // NaN for fewer than two seeds
  std::vector<std::pair<std::string, double>> measures;
};
/// Called after each trial with those that are done and all; from any thread.
using MeasureProgress = std::function<void(const std::string& task, std::size_t done, std::size_t all)>;
Measurement measure(const Task& task, const agent::AgentParameters& parameters,
                    const std::vector<std::uint64_t>& seeds, const TaskSettings& settings, int threads,
                    const MeasureProgress& progress = {});

/// Measures a learned file again with the seeds of its provenance, one entry per task.
struct Repetition {
  Provenance recorded;
  Measurement repeated;
};
std::vector<Repetition> repeatLearned(const std::string& file, const std::string& dataFolder, int threads,
                                      const MeasureProgress& progress = {});

}  // namespace nonet::lab
