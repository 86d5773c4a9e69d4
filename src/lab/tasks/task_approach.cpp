// approach: from 1.5 m to the place for the kick that motion chooses, the ball often rolling, seen with the
// robot's own eyes (lab/trial/ball_trial.h). The fitness is minus the mean time of three approaches in
// seconds; one that does not come to its place within 10 s counts those, and a fall 5 s more.
#include "nonet/lab/trial/ball_trial.h"
#include "nonet/math/random.h"

#include "lab/tasks/tasks.h"

namespace nonet::lab {

namespace {

constexpr std::uint64_t kApproachDraws = 9;  // stream of what this task draws

constexpr int kApproaches = 3;
constexpr double kApproachFall = 5.0;  // s

class ApproachTask final : public Task {
 public:
  std::string_view name() const override { return "approach"; }
  std::string_view description() const override {
    return "from 1.5 m, all around a ball that may roll, to the place for the kick";
  }
  std::vector<std::string> searchedKeys() const override {
    return {"team.ball.behindBall",     "team.ball.circleRadius", "team.ball.kickApproach",
            "team.ball.handleDistance", "motion.kick.gain",       "motion.kick.leastSpeed",
            "motion.kick.mostSpeed"};
  }

  TaskResult evaluate(const agent::AgentParameters& parameters, std::uint64_t seed,
                      const TaskSettings& settings) const override {
    const agent::AgentSettings agent = agentOf(parameters, settings);
    const sim::Settings server = serverOf(settings);
    Random random = Random(seed).fork(kApproachDraws);
    double cost = 0.0, arrived = 0.0, falls = 0.0;
    for (int i = 0; i < kApproaches; ++i) {
      const Approach approach = approachOnce(agent, server, random.next());
      cost += approach.time + (approach.fell ? kApproachFall : 0.0);
      arrived += approach.arrived ? 1.0 : 0.0;
      falls += approach.fell ? 1.0 : 0.0;
    }
    return {.fitness = -cost / kApproaches,
            .measures = {{"arrived", arrived / kApproaches}, {"falls", falls}}};
  }
};

}  // namespace

const Task& approachTask() {
  static const ApproachTask task;
  return task;
}

}  // namespace nonet::lab
