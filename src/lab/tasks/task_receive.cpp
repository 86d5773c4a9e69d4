// receive: two passes, seen with the robot's own eyes, to be stopped or taken along (lab/trial/ball_trial.h).
// The fitness of a pass is 1 if it is held, otherwise minus the distance to which it rebounds (at most 1 m);
// 1 less for a fall.
#include <algorithm>

#include "nonet/lab/trial/ball_trial.h"
#include "nonet/math/random.h"

#include "lab/tasks/tasks.h"

namespace nonet::lab {

namespace {

constexpr std::uint64_t kReceiveDraws = 8;  // stream of what this task draws

constexpr int kPasses = 2;
constexpr double kMostRebound = 1.0;  // m
constexpr double kReceiveFall = 1.0;

class ReceiveTask final : public Task {
 public:
  std::string_view name() const override { return "receive"; }
  std::string_view description() const override { return "a pass stopped, or taken along, at the feet"; }
  std::vector<std::string> searchedKeys() const override { return {"team.receive."}; }
  void prepare(agent::AgentParameters& parameters) const override { parameters.team.receive.use = true; }

  TaskResult evaluate(const agent::AgentParameters& parameters, std::uint64_t seed,
                      const TaskSettings& settings) const override {
    const agent::AgentSettings agent = agentOf(parameters, settings);
    const sim::Settings server = serverOf(settings);
    Random random = Random(seed).fork(kReceiveDraws);
    double fitness = 0.0, held = 0.0, rebound = 0.0, falls = 0.0;
    for (int i = 0; i < kPasses; ++i) {
      const Reception pass = receiveOnce(agent, server, random.next(), false);
      fitness += (pass.held ? 1.0 : -std::min(pass.rebound, kMostRebound)) - (pass.fell ? kReceiveFall : 0.0);
      held += pass.held ? 1.0 : 0.0;
      rebound += pass.rebound;
      falls += pass.fell ? 1.0 : 0.0;
    }
    return {.fitness = fitness / kPasses,
            .measures = {{"held", held / kPasses}, {"rebound_m", rebound / kPasses}, {"falls", falls}}};
  }
};

}  // namespace

const Task& receiveTask() {
  static const ReceiveTask task;
  return task;
}

}  // namespace nonet::lab
