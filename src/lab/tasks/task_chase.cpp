// chase: after a target that leaps aside, half as hard as in `run` (lab/trial/run_trial.h): where to begin a
// run that is to become faster, since the fastest ones bear nothing yet. It moves what `run` moves.
#include "nonet/lab/trial/run_trial.h"
#include "nonet/math/random.h"

#include "lab/tasks/run_worth.h"
#include "lab/tasks/tasks.h"

namespace nonet::lab {

namespace {

constexpr std::uint64_t kChaseDraws = 10;  // stream of what this task draws

constexpr double kHardness = 0.5;

class ChaseTask final : public Task {
 public:
  std::string_view name() const override { return "chase"; }
  std::string_view description() const override {
    return "a run of 8 s after a far target that leaps aside, out of a stand or a walk, among pushes, half "
           "as hard as in `run`: its mean speed, 0.4 to 1 m/s less for a fall";
  }
  std::vector<std::string> searchedKeys() const override { return {"motion.run.", "motion.sprint."}; }

  void prepare(agent::AgentParameters& parameters) const override { beginRun(parameters); }

  TaskResult evaluate(const agent::AgentParameters& parameters, std::uint64_t seed,
                      const TaskSettings& settings) const override {
    const TrialSettings setup = trialSettings(parameters, seed, settings);
    const RunOutcome run = runAfter(setup, Random(seed).fork(kChaseDraws).next(), kHardness);
    return {.fitness = worth(run), .measures = {{"speed_mps", run.fast}, {"falls", run.fell ? 1.0 : 0.0}}};
  }
};

}  // namespace

const Task& chaseTask() {
  static const ChaseTask task;
  return task;
}

}  // namespace nonet::lab
