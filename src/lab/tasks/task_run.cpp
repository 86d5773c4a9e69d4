// run: as fast as it can without a fall, straight ahead and after a target that leaps aside
// (lab/trial/run_trial.h). It moves the sprint set and what the run adds to its joints.
#include "nonet/lab/trial/run_trial.h"
#include "nonet/math/random.h"

#include "lab/tasks/run_worth.h"
#include "lab/tasks/tasks.h"

namespace nonet::lab {

namespace {

constexpr std::uint64_t kRunDraws = 10;  // stream of what this task draws

constexpr int kRuns = 2;  // of either kind

class RunTask final : public Task {
 public:
  std::string_view name() const override { return "run"; }
  std::string_view description() const override {
    return "runs straight ahead, out of a stand or a walk, among light pushes, with the stop after them, and "
           "after a target that leaps aside: their mean speed, 0.4 to 1 m/s less for a fall, 0.4 for each "
           "second of a late stop, and less for near falls";
  }
  std::vector<std::string> searchedKeys() const override { return {"motion.run.", "motion.sprint."}; }

  void prepare(agent::AgentParameters& parameters) const override { beginRun(parameters); }

  TaskResult evaluate(const agent::AgentParameters& parameters, std::uint64_t seed,
                      const TaskSettings& settings) const override {
    const TrialSettings setup = trialSettings(parameters, seed, settings);
    Random random = Random(seed).fork(kRunDraws);
    double fitness = 0.0, fast = 0.0, falls = 0.0, fallsAfter = 0.0, stopTime = 0.0, chase = 0.0;
    for (int i = 0; i < kRuns; ++i) {
      const RunOutcome run = runAhead(setup, random.next());
      const RunOutcome after = runAfter(setup, random.next());
      fitness += (worth(run) + worth(after)) / (2 * kRuns);
      fast += run.fast / kRuns;
      chase += after.speed / kRuns;
      falls += after.fell ? 1.0 : 0.0;
      falls += run.fell ? 1.0 : 0.0;
      fallsAfter += run.fellAfter ? 1.0 : 0.0;
      stopTime += run.stopTime / kRuns;
    }
    return {.fitness = fitness,
            .measures = {{"speed_mps", fast},
                         {"chase_mps", chase},
                         {"falls", falls},
                         {"falls_after", fallsAfter},
                         {"stop_s", stopTime}}};
  }
};

}  // namespace

const Task& runTask() {
  static const RunTask task;
  return task;
}

}  // namespace nonet::lab
