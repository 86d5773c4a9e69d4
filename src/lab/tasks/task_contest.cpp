// contest: duels for a ball that lies between two robots (lab/trial/ball_trial.h), against the same robot as
// the data folder has it. A duel is worth 1 if the ball comes 2 m towards the other goal first, 0 if towards
// the own one, and a fall costs 0.3: whoever lies is missed in the next one.
#include "nonet/math/random.h"

#include "lab/tasks/duel_tally.h"
#include "lab/tasks/tasks.h"

namespace nonet::lab {

namespace {

constexpr std::uint64_t kContestDraws = 9;  // stream of what this task draws

constexpr int kDuels = 10;
constexpr double kContestFall = 0.3;

class ContestTask final : public Task {
 public:
  std::string_view name() const override { return "contest"; }
  std::string_view description() const override {
    return "duels for a ball between two robots, against the robot of the data folder";
  }
  std::vector<std::string> searchedKeys() const override { return {"team.ball.", "team.target."}; }

  TaskResult evaluate(const agent::AgentParameters& parameters, std::uint64_t seed,
                      const TaskSettings& settings) const override {
    const agent::AgentSettings agent = agentOf(parameters, settings);
    const agent::AgentSettings opponent = dataAgent(settings, settings.robotType);
    const sim::Settings server = serverOf(settings);
    Random random = Random(seed).fork(kContestDraws);
    const DuelTally duels = fightDuels(kDuels, agent, opponent, server, random);
    return {.fitness = duels.won - kContestFall * duels.falls / kDuels,
            .measures = {{"won", duels.won}, {"falls", duels.falls}}};
  }
};

}  // namespace

const Task& contestTask() {
  static const ContestTask task;
  return task;
}

}  // namespace nonet::lab
