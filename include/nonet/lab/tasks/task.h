// What can be learned: a task turns agent parameters and a seed into a fitness (higher is better). Tasks run
// the real agent code on the in-process physics. A new task is one file, its declaration in tasks.h and its
// line in task_list.cpp (docs/how-to.md).
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "nonet/agent/parameters.h"

namespace nonet::lab {

struct TaskSettings {
  int robotType = 0;
  bool quickSolver = false;  // the quick stepper: the same equations, faster, differs by rounding
  std::string dataFolder;    // holds params/ and skills/
};

struct TaskResult {
  double fitness = 0.0;
  /// Named measures that explain the fitness ("falls", "distance_m", ...), the same names in every result of
  /// a task.
  std::vector<std::pair<std::string, double>> measures;
};

class Task {
 public:
  virtual ~Task() = default;
  virtual std::string_view name() const = 0;
  virtual std::string_view description() const = 0;
  /// Prefixes of the parameter keys that the optimizer moves by default ("motion.walk.").
  virtual std::vector<std::string> searchedKeys() const = 0;
  /// Called from several threads at once. The same arguments always give the same result.
  virtual TaskResult evaluate(const agent::AgentParameters& parameters, std::uint64_t seed,
                              const TaskSettings& settings) const = 0;
  /// Before the search starts: switches that the task needs on (the sprint task uses the sprint set).
  virtual void prepare(agent::AgentParameters& /*parameters*/) const {}
  /// Not in listings: for tests of the optimizer itself.
  virtual bool hidden() const { return false; }
};

std::span<const Task* const> registeredTasks();
/// Throws std::runtime_error that lists the known names.
const Task& findTask(std::string_view name);

}  // namespace nonet::lab
