// kick: from the stand, with either foot, the ball some centimetres off its place. As in [MacAlpine 2012a,
// section 5.2]: the mean distance towards the target, -1 for a fall or a miss; what goes aside and the time
// it takes count against it.
#include <cmath>

#include "nonet/lab/trial/kick_trial.h"

#include "lab/tasks/tasks.h"

namespace nonet::lab {

namespace {

constexpr int kKicks = 2;           // one with each foot
constexpr double kPenalty = -1.0;   // m
constexpr double kPerSecond = 0.5;  // m/s

class KickTask final : public Task {
 public:
  std::string_view name() const override { return "kick"; }
  std::string_view description() const override {
    return "kick forward from the stand: far, straight, soon and without a fall";
  }
  std::vector<std::string> searchedKeys() const override { return {"motion.skills.kick_forward."}; }

  TaskResult evaluate(const agent::AgentParameters& parameters, std::uint64_t seed,
                      const TaskSettings& settings) const override {
    const TrialSetup setup = trialSetup(parameters, seed, settings);
    Random random = Random(seed).fork(6);
    double fitness = 0.0;
    double distance = 0.0;
    double aside = 0.0;
    double duration = 0.0;
    int failures = 0;
    for (const model::Side side : {model::Side::Left, model::Side::Right}) {
      const Kick kick = kickOnce(setup, side, KickFrom::Stand, random.next());
      const bool failed = kick.fell || kick.missed();
      failures += failed ? 1 : 0;
      distance += kick.forward / kKicks;
      aside += std::abs(kick.aside) / kKicks;
      duration += kick.duration / kKicks;
      const double gained = kick.forward - std::abs(kick.aside) - kPerSecond * kick.duration;
      fitness += (failed ? kPenalty : gained) / kKicks;
    }
    return {.fitness = fitness,
            .measures = {{"distance_m", distance},
                         {"aside_m", aside},
                         {"duration_s", duration},
                         {"failures", static_cast<double>(failures) / kKicks}}};
  }
};

}  // namespace

const Task& kickTask() {
  static const KickTask task;
  return task;
}

}  // namespace nonet::lab
