// A task without a robot, for tests of the optimizer and its distribution: a quadratic function of the walk
// parameters, with noise that depends on the seed alone.
#include <cmath>

#include "nonet/config/parameters.h"
#include "nonet/math/random.h"

#include "lab/tasks/tasks.h"

namespace nonet::lab {

namespace {

class QuadraticTask final : public Task {
 public:
  std::string_view name() const override { return "quadratic"; }
  std::string_view description() const override { return "a quadratic function of the walk parameters"; }
  std::vector<std::string> searchedKeys() const override {
    return {"motion.walk.gait.maxStep", "motion.walk.gait.stepHeight", "motion.walk.pendulum.torsoHeight"};
  }
  bool hidden() const override { return true; }

  TaskResult evaluate(const agent::AgentParameters& parameters, std::uint64_t seed,
                      const TaskSettings& /*settings*/) const override {
    double sum = 0.0;
    int i = 0;
    for (const config::ParameterView& view : config::listParameters(parameters.motion.sets.goToTarget)) {
      if (!view.declaration.searchRange) continue;
      const config::Range& range = *view.declaration.searchRange;
      const double share = (view.value - range.low) / (range.high - range.low);
      sum += std::pow(share - 0.5 - 0.1 * std::sin(i++), 2);
    }
    const double noise = 0.05 * Random(seed).normal();
    return {.fitness = noise - sum, .measures = {{"noise", noise}}};
  }
};

}  // namespace

const Task& quadraticTask() {
  static const QuadraticTask task;
  return task;
}

}  // namespace nonet::lab
