// run: straight ahead as fast as it can without a fall (lab/trial/run_trial.h). It moves the sprint set and
// what the run adds to its joints.
#include <algorithm>

#include "nonet/lab/trial/run_trial.h"
#include "nonet/math/random.h"

#include "lab/tasks/tasks.h"

namespace nonet::lab {

namespace {

constexpr int kRuns = 4;
// In m/s of the mean speed. A fall costs the less the later it comes, which gives the search a slope.
constexpr double kFall = 1.0;
constexpr double kLateFall = 0.4;
constexpr double kFallAfter = 0.5;
constexpr double kStopTime = 0.7;       // s, free
constexpr double kStopCost = 0.2;       // per s beyond
constexpr double kUnsteadiness = 0.08;  // per s

double worth(const RunOutcome& run) {
  double value = run.speed - kUnsteadiness * run.unsteadiness;
  if (run.fell) value -= kFall + (kLateFall - kFall) * run.fellAt;
  if (run.fellAfter) value -= kFallAfter;
  return value - kStopCost * std::max(0.0, run.stopTime - kStopTime);
}

class RunTask final : public Task {
 public:
  std::string_view name() const override { return "run"; }
  std::string_view description() const override {
    return "a run straight ahead, out of a stand or a walk, among light pushes, and the stop after it: its "
           "mean speed, 0.4 to 1 m/s less for a fall";
  }
  std::vector<std::string> searchedKeys() const override { return {"motion.run.", "motion.sprint."}; }

  // The search begins at the walk set, unless a sprint set was learned before.
  void prepare(agent::AgentParameters& parameters) const override {
    parameters.motion.selection.useSprint = true;
    startAt(parameters.motion.sets.goToTarget, parameters.motion.sets.sprint);
  }

  TaskResult evaluate(const agent::AgentParameters& parameters, std::uint64_t seed,
                      const TaskSettings& settings) const override {
    const TrialSettings setup = trialSettings(parameters, seed, settings);
    Random random = Random(seed).fork(10);
    double fitness = 0.0, fast = 0.0, falls = 0.0, fallsAfter = 0.0, stopTime = 0.0;
    for (int i = 0; i < kRuns; ++i) {
      const RunOutcome run = runAhead(setup, random.next());
      fitness += worth(run) / kRuns;
      fast += run.fast / kRuns;
      falls += run.fell ? 1.0 : 0.0;
      fallsAfter += run.fellAfter ? 1.0 : 0.0;
      stopTime += run.stopTime / kRuns;
    }
    return {.fitness = fitness,
            .measures = {
                {"speed_mps", fast}, {"falls", falls}, {"falls_after", fallsAfter}, {"stop_s", stopTime}}};
  }
};

}  // namespace

const Task& runTask() {
  static const RunTask task;
  return task;
}

}  // namespace nonet::lab
