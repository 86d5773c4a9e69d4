// scrum: three robots a side around a contested ball (lab/trial/scrum_trial.h), against the same robot as the
// data folder has it. The fitness is how far the ball comes, m, less for robots that the referee takes off.
// What is learned is for all who play near the ball; `--keys` names other parts of it.
#include "nonet/lab/trial/scrum_trial.h"
#include "nonet/math/random.h"

#include "lab/tasks/tasks.h"

namespace nonet::lab {

namespace {

constexpr std::uint64_t kScrumDraws = 9;  // stream of what this task draws

constexpr int kScrums = 4;
constexpr double kCharge = 0.5;  // m

class ScrumTask final : public Task {
 public:
  std::string_view name() const override { return "scrum"; }
  std::string_view description() const override {
    return "the ground that three robots gain around the ball against three of the data folder";
  }
  std::vector<std::string> searchedKeys() const override {
    return {"team.ball.", "team.target.", "team.navigation.", "team.pace."};
  }

  TaskResult evaluate(const agent::AgentParameters& parameters, std::uint64_t seed,
                      const TaskSettings& settings) const override {
    const agent::AgentSettings agent = agentOf(parameters, settings);
    const agent::AgentSettings opponent = dataAgent(settings, settings.robotType);
    const sim::Settings server = serverOf(settings);
    Random random = Random(seed).fork(kScrumDraws);
    double gained = 0.0, falls = 0.0, charges = 0.0;
    for (int i = 0; i < kScrums; ++i) {
      const Scrum scrum = scrumOnce(ScrumBall::Contested, agent, opponent, server, random.next());
      gained += scrum.gained / kScrums;
      falls += scrum.falls / kScrums;
      charges += scrum.charges / kScrums;
    }
    return {.fitness = gained - kCharge * charges,
            .measures = {{"gained_m", gained}, {"falls", falls}, {"charges", charges}}};
  }
};

}  // namespace

const Task& scrumTask() {
  static const ScrumTask task;
  return task;
}

}  // namespace nonet::lab
