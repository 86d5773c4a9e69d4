// attack: the end of attacks (lab/trial/ball_trial.h): one with the ball near the goal, against a goalie and
// two backs as the data folder has them. Worth 1 for a goal, 0.3 for a ball that is still there after 25 s; a
// fall costs 0.1, a charging foul 0.2: the robot is missed after them.
#include "nonet/lab/trial/ball_trial.h"
#include "nonet/math/random.h"

#include "lab/tasks/tasks.h"

namespace nonet::lab {

namespace {

constexpr std::uint64_t kAttackDraws = 10;  // stream of what this task draws

constexpr int kAttacks = 10;
constexpr double kAttackFall = 0.1;
constexpr double kCharge = 0.2;

class AttackTask final : public Task {
 public:
  std::string_view name() const override { return "attack"; }
  std::string_view description() const override {
    return "the end of attacks, against a goalie and two backs of the data folder";
  }
  std::vector<std::string> searchedKeys() const override {
    return {"team.shot.", "team.target.", "team.ball.", "team.charging."};
  }

  TaskResult evaluate(const agent::AgentParameters& parameters, std::uint64_t seed,
                      const TaskSettings& settings) const override {
    const agent::AgentSettings agent = agentOf(parameters, settings);
    const Defence defence{dataAgent(settings, 0), dataAgent(settings, settings.robotType)};
    const sim::Settings server = serverOf(settings);
    Random random = Random(seed).fork(kAttackDraws);
    double worth = 0.0, goals = 0.0, falls = 0.0, charges = 0.0;
    for (int i = 0; i < kAttacks; ++i) {
      const Attack attack = attackOnce(agent, defence, server, random.next());
      worth += attack.worth() / kAttacks;
      goals += attack.goal ? 1.0 / kAttacks : 0.0;
      falls += attack.fell ? 1.0 : 0.0;
      charges += attack.charged ? 1.0 / kAttacks : 0.0;
    }
    return {.fitness = worth - kAttackFall * falls / kAttacks - kCharge * charges,
            .measures = {{"goals", goals}, {"falls", falls}, {"charged", charges}}};
  }
};

}  // namespace

const Task& attackTask() {
  static const AttackTask task;
  return task;
}

}  // namespace nonet::lab
