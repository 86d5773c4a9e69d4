// dribble: the ball along a straight line of ten metres and through a slalom, seen with the robot's own eyes
// (lab/trial/ball_trial.h). The fitness is the ball's mean speed on both less 2 m/s for the share of the time
// in which it is lost, 0.8 if it is lost at all, 0.5 for a fall and 0.5 for a foul by collisions with
// oneself.
#include "nonet/lab/trial/ball_trial.h"
#include "nonet/math/random.h"

#include "lab/tasks/tasks.h"

namespace nonet::lab {

namespace {

constexpr std::uint64_t kDribbleDraws = 7;  // stream of what this task draws

constexpr double kAway = 2.0;  // m/s
constexpr double kLost = 0.8;  // m/s
constexpr double kDribbleFall = 0.5;
constexpr double kFoul = 0.5;

class DribbleTask final : public Task {
 public:
  std::string_view name() const override { return "dribble"; }
  std::string_view description() const override {
    return "the ball kept at the feet along a straight line and through a slalom: fast, without a loss, a "
           "fall or a self-collision";
  }
  std::vector<std::string> searchedKeys() const override { return {"team.dribble.", "motion.dribble."}; }
  // The search begins at the positioning set, unless a dribble set was learned before.
  void prepare(agent::AgentParameters& parameters) const override {
    parameters.motion.selection.useDribble = true;
    startAt(parameters.motion.sets.positioning, parameters.motion.sets.dribble);
  }

  TaskResult evaluate(const agent::AgentParameters& parameters, std::uint64_t seed,
                      const TaskSettings& settings) const override {
    const agent::AgentSettings agent = agentOf(parameters, settings);
    const sim::Settings server = serverOf(settings);
    Random random = Random(seed).fork(kDribbleDraws);
    const Dribble straight = dribbleOnce(agent, server, random.next());
    const Dribble slalom = slalomOnce(agent, server, random.next());
    return {.fitness = 0.5 * (worth(straight) + worth(slalom)),
            .measures = {{"straight_mps", straight.speed},
                         {"straight_away", straight.away},
                         {"straight_lost", straight.lost ? 1.0 : 0.0},
                         {"slalom_mps", slalom.speed},
                         {"slalom_away", slalom.away},
                         {"slalom_lost", slalom.lost ? 1.0 : 0.0},
                         {"falls", (straight.fell ? 1.0 : 0.0) + (slalom.fell ? 1.0 : 0.0)},
                         {"fouls", straight.selfCollisions + slalom.selfCollisions}}};
  }

 private:
  static double worth(const Dribble& dribble) {
    return dribble.speed - kAway * dribble.away - (dribble.lost ? kLost : 0.0) -
           (dribble.fell ? kDribbleFall : 0.0) - kFoul * dribble.selfCollisions;
  }
};

}  // namespace

const Task& dribbleTask() {
  static const DribbleTask task;
  return task;
}

}  // namespace nonet::lab
