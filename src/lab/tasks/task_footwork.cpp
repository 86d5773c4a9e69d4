// footwork: the approach (task_approach.cpp) among pushes as at a contested ball. It moves the positioning
// set: what learns to approach without pushes falls at the first one. The fitness is minus the mean time of
// three approaches in seconds; one that does not come to its place within 10 s counts those, and a fall 5 s
// more.
#include "nonet/lab/trial/ball_trial.h"
#include "nonet/math/random.h"

#include "lab/tasks/tasks.h"

namespace nonet::lab {

namespace {

constexpr int kApproaches = 3;
constexpr double kFall = 5.0;  // s
constexpr double kPush = 0.4;  // m/s

class FootworkTask final : public Task {
 public:
  std::string_view name() const override { return "footwork"; }
  std::string_view description() const override {
    return "the approach among pushes of up to 0.4 m/s as at a contested ball";
  }
  std::vector<std::string> searchedKeys() const override { return {"motion.positioning."}; }

  TaskResult evaluate(const agent::AgentParameters& parameters, std::uint64_t seed,
                      const TaskSettings& settings) const override {
    const agent::AgentSettings agent = agentOf(parameters, settings);
    const sim::Settings server = serverOf(settings);
    Random random = Random(seed).fork(9);
    double cost = 0.0, arrived = 0.0, falls = 0.0;
    for (int i = 0; i < kApproaches; ++i) {
      const Approach approach = approachOnce(agent, server, random.next(), kPush);
      cost += approach.time + (approach.fell ? kFall : 0.0);
      arrived += approach.arrived ? 1.0 : 0.0;
      falls += approach.fell ? 1.0 : 0.0;
    }
    return {.fitness = -cost / kApproaches,
            .measures = {{"arrived", arrived / kApproaches}, {"falls", falls}}};
  }
};

}  // namespace

const Task& footworkTask() {
  static const FootworkTask task;
  return task;
}

}  // namespace nonet::lab
