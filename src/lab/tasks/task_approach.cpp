// approach: from 1.5 m to the place for the kick that motion chooses, the ball often rolling, seen with the
// robot's own eyes (lab/trial/ball_trial.h). The fitness is minus the mean time of three approaches in
// seconds; one that does not come to its place within 10 s counts those, and a fall 5 s more.
// footwork: the same among pushes as at a contested ball, for the positioning set: what learns to approach
// without pushes falls at the first one.
#include <utility>

#include "nonet/lab/trial/ball_trial.h"
#include "nonet/math/random.h"

#include "lab/tasks/tasks.h"

namespace nonet::lab {

namespace {

constexpr int kApproaches = 3;
constexpr double kFall = 5.0;  // s
constexpr double kPush = 0.4;  // m/s

class ApproachTask final : public Task {
 public:
  /// The texts must outlive the task; `push` in m/s.
  ApproachTask(std::string_view name, std::string_view description, std::vector<std::string> keys,
               double push)
      : name_(name), description_(description), keys_(std::move(keys)), push_(push) {}

  std::string_view name() const override { return name_; }
  std::string_view description() const override { return description_; }
  std::vector<std::string> searchedKeys() const override { return keys_; }

  TaskResult evaluate(const agent::AgentParameters& parameters, std::uint64_t seed,
                      const TaskSettings& settings) const override {
    const agent::AgentSettings agent = agentOf(parameters, settings);
    const sim::Settings server = serverOf(settings);
    Random random = Random(seed).fork(9);
    double cost = 0.0, arrived = 0.0, falls = 0.0;
    for (int i = 0; i < kApproaches; ++i) {
      const Approach approach = approachOnce(agent, server, random.next(), push_);
      cost += approach.time + (approach.fell ? kFall : 0.0);
      arrived += approach.arrived ? 1.0 : 0.0;
      falls += approach.fell ? 1.0 : 0.0;
    }
    return {.fitness = -cost / kApproaches,
            .measures = {{"arrived", arrived / kApproaches}, {"falls", falls}}};
  }

 private:
  std::string_view name_;
  std::string_view description_;
  std::vector<std::string> keys_;
  double push_;
};

}  // namespace

const Task& approachTask() {
  static const ApproachTask task(
      "approach", "from 1.5 m, all around a ball that may roll, to the place for the kick",
      {"team.ball.behindBall", "team.ball.circleRadius", "team.ball.kickApproach", "team.ball.handleDistance",
       "motion.kick.gain", "motion.kick.leastSpeed", "motion.kick.mostSpeed"},
      0.0);
  return task;
}

const Task& footworkTask() {
  static const ApproachTask task("footwork",
                                 "the approach among pushes of up to 0.4 m/s as at a contested ball",
                                 {"motion.positioning."}, kPush);
  return task;
}

}  // namespace nonet::lab
