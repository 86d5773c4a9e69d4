// save: the share of seeded shots that the whole agent saves (lab/trial/save_trial.h), and that it is on its
// feet afterwards.
#include "nonet/lab/trial/save_trial.h"
#include "nonet/math/random.h"

#include "lab/tasks/tasks.h"

namespace nonet::lab {

namespace {

constexpr std::uint64_t kSaveDraws = 8;  // stream of what this task draws

constexpr int kShots = 4;         // a trial: two rolling, two flying
constexpr double kDown = 0.3;     // that a robot costs which lies in the end
constexpr double kOwnGoal = 1.0;  // on top of the goal

class SaveTask final : public Task {
 public:
  std::string_view name() const override { return "save"; }
  std::string_view description() const override {
    return "the goalie's place and the moment of its dive: share of shots saved, rolling and flying, "
           "less for an own goal and for who stays down";
  }
  std::vector<std::string> searchedKeys() const override {
    return {"team.goalie.outOfGoal",    "team.goalie.outShare",     "team.goalie.diveTime",
            "team.goalie.highDiveTime", "team.goalie.diveReach",    "team.goalie.sideStepSpeed",
            "team.goalie.stepDelay",    "team.goalie.diveFarthest", "team.goalie.blockTime",
            "team.goalie.blockReach"};
  }

  TaskResult evaluate(const agent::AgentParameters& parameters, std::uint64_t seed,
                      const TaskSettings& settings) const override {
    const agent::AgentSettings goalie = agentOf(parameters, settings);
    const sim::Settings server = serverOf(settings);
    Random random = Random(seed).fork(kSaveDraws);
    double rolling = 0.0, flying = 0.0, falls = 0.0, fitness = 0.0;
    for (int i = 0; i < kShots; ++i) {
      const ShotKind kind = i % 2 == 0 ? ShotKind::Rolling : ShotKind::Flying;
      const Shot shot = drawShot(kind, random);
      const Save save = saveOnce(goalie, server, shot, random.next());
      const double saved = save.saved ? 1.0 : 0.0;
      (kind == ShotKind::Rolling ? rolling : flying) += 2.0 * saved / kShots;
      falls += save.fell ? 1.0 : 0.0;
      fitness += (saved - (save.up ? 0.0 : kDown) - (save.ownGoal ? kOwnGoal : 0.0)) / kShots;
    }
    return {.fitness = fitness, .measures = {{"rolling", rolling}, {"flying", flying}, {"falls", falls}}};
  }
};

}  // namespace

const Task& saveTask() {
  static const SaveTask task;
  return task;
}

}  // namespace nonet::lab
