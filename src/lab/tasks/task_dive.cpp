// dive: how far to the side, and how soon, the goalie bars the way; and that it rises afterwards.
#include <numeric>

#include "nonet/lab/trial/dive_trial.h"

#include "lab/tasks/tasks.h"

namespace nonet::lab {

namespace {

constexpr double kFailure = 0.3;     // m of reach that a failed first attempt to rise costs
constexpr double kPerSecond = 0.02;  // m per second of rising

class DiveTask final : public Task {
 public:
  std::string_view name() const override { return "dive"; }
  std::string_view description() const override {
    return "the goalie's dive: reach to the side 0.4 to 1 s after the request, and rising from it";
  }
  std::vector<std::string> searchedKeys() const override { return {"motion.skills.dive."}; }

  TaskResult evaluate(const agent::AgentParameters& parameters, std::uint64_t seed,
                      const TaskSettings& settings) const override {
    const TrialSetup setup = trialSetup(parameters, seed, settings);
    Random random = Random(seed).fork(7);
    double reach = 0.0;
    double farthest = 0.0;
    double time = 0.0;
    double failures = 0.0;
    for (const model::Side side : {model::Side::Left, model::Side::Right}) {
      const Dive dive = diveAndRise(setup, side, random.next());
      reach += 0.5 * std::accumulate(dive.reach.begin(), dive.reach.end(), 0.0) / Dive::kTimes.size();
      farthest += 0.5 * dive.reach.back();
      time += 0.5 * dive.riseTime;
      failures += dive.stands && dive.attempts <= 1 ? 0.0 : 0.5;
    }
    return {
        .fitness = reach - kFailure * failures - kPerSecond * time,
        .measures = {{"reach_m", reach}, {"reach_1s_m", farthest}, {"rise_s", time}, {"failures", failures}}};
  }
};

}  // namespace

const Task& diveTask() {
  static const DiveTask task;
  return task;
}

}  // namespace nonet::lab
