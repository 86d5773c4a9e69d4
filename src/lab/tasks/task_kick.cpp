// kick_NAME: one kick of the catalogue with the whole approach, as in [MacAlpine 2012a, section 5.2]: from
// ten directions on a half circle, the ball where it is seen, sometimes rolling. The fitness is the distance
// towards the target less what goes aside and 1.2 m for every second; -1 for a fall, a self-collision, a miss
// or a ball that leaves by more than ten degrees. Of a kick that goes as far as is asked for, the error
// counts instead of the distance, of a chip the height. played_NAME: the same of kick_NAME with the ball as
// play leaves it, often rolling away, or to the robot's feet. aimed_NAME: the same as that, for shots: what
// goes aside counts four times, as from six metres on it decides whether there is a goal.
#include <cmath>
#include <string>

#include "nonet/lab/trial/kick_trial.h"
#include "nonet/math/angle.h"
#include "nonet/math/random.h"

#include "lab/tasks/kick_worth.h"
#include "lab/tasks/named_tasks.h"
#include "lab/tasks/tasks.h"

namespace nonet::lab {

namespace {

constexpr std::uint64_t kKickDraws = 6;  // stream of what this task draws

constexpr int kKicks = 4;           // a trial: four bearings
constexpr double kPenalty = -1.0;   // m
constexpr double kPerSecond = 1.2;  // m/s
constexpr double kStraight = toRadians(10.0);
constexpr double kRolling = 0.3;    // m/s
constexpr double kFaster = 0.5;     // m/s, in play
constexpr double kLeastPush = 0.2;  // m/s, of a ball that rolls straight away
constexpr double kMostPush = 0.6;
constexpr double kSlowestPass = 1.5;  // m/s, of a ball that rolls to the robot's feet
constexpr double kFastestPass = 3.0;
constexpr double kNearest = 0.3;   // m from the ball, where the approach begins
constexpr double kFarthest = 1.5;  // m

class KickTask : public Task {
 public:
  explicit KickTask(std::string kick) : kick_(std::move(kick)) {}

  std::string_view name() const override { return kick_; }
  std::string_view description() const override {
    return "a kick with its approach: far, straight, soon and without a fall";
  }
  std::vector<std::string> searchedKeys() const override { return {"motion.skills." + kick_ + "."}; }

  TaskResult evaluate(const agent::AgentParameters& parameters, std::uint64_t seed,
                      const TaskSettings& settings) const override {
    const agent::AgentSettings agent = agentOf(parameters, settings);
    const sim::Settings server = serverOf(settings);
    const motion::KickHead head = kickHead(agent, kick_);
    Random random = Random(seed).fork(kKickDraws);
    const int first = random.uniform() < 0.5 ? 0 : 5;
    TaskResult result;
    double distance = 0.0, aside = 0.0, time = 0.0, falls = 0.0, fouls = 0.0, failures = 0.0;
    for (int i = 0; i < kKicks; ++i) {
      KickScene scene;
      scene.kick = kick_;
      scene.bearing = kickBearing(first + 3 * i);
      roll(i, scene, random);
      scene.start = random.uniform(kNearest, kFarthest);
      if (head.scales) {
        scene.distance = random.uniform(head.shortest, head.longest);
        scene.stops = true;
      }
      const Kick kick = kickOnce(agent, server, scene, random.next());
      const bool failed =
          kick.fell || kick.selfCollided || kick.missed() || std::abs(kick.direction()) > kStraight;
      const double gained = worthOfWay(kick, head, scene.distance) - asideCounts() * std::abs(kick.aside) -
                            kPerSecond * kick.time;
      result.fitness += (failed ? kPenalty : gained) / kKicks;
      distance += kick.forward / kKicks;
      aside += std::abs(kick.aside) / kKicks;
      time += kick.time / kKicks;
      falls += kick.fell ? 1.0 : 0.0;
      fouls += kick.selfCollided ? 1.0 : 0.0;
      failures += failed ? 1.0 / kKicks : 0.0;
    }
    result.measures = {{"distance_m", distance}, {"aside_m", aside},         {"time_s", time},
                       {"falls", falls},         {"self_collisions", fouls}, {"failures", failures}};
    return result;
  }

 private:
  virtual double asideCounts() const { return 1.0; }
  // Of the trial's i-th kick.
  virtual void roll(int i, KickScene& scene, Random& /*random*/) const {
    scene.rolling = i % 2 == 0 ? 0.0 : kRolling;
  }

  std::string kick_;
};

class PlayedKickTask : public KickTask {
 public:
  explicit PlayedKickTask(const std::string& name, const std::string& kind = "played_")
      : KickTask("kick_" + name), name_(kind + name) {}

  std::string_view name() const override { return name_; }
  std::string_view description() const override {
    return "the same with the ball as play leaves it: resting, rolling anywhere, pushed ahead, or passed";
  }

 private:
  void roll(int i, KickScene& scene, Random& random) const override {
    if (i == 1) scene.rolling = kFaster;
    if (i == 2) scene.pushed = random.uniform(kLeastPush, kMostPush);
    if (i == 3) scene.passed = random.uniform(kSlowestPass, kFastestPass);
  }

  std::string name_;
};

class AimedKickTask final : public PlayedKickTask {
 public:
  explicit AimedKickTask(const std::string& name) : PlayedKickTask(name, "aimed_") {}

  std::string_view description() const override {
    return "the same with the ball as play leaves it; what goes aside counts four times: for shots";
  }

 private:
  double asideCounts() const override { return 4.0; }
};

}  // namespace

const Task& kickTask(std::string_view name) {
  return taskNamed<KickTask>(name);
}

const Task& playedKickTask(std::string_view name) {
  return taskNamed<PlayedKickTask>(name);
}

const Task& aimedKickTask(std::string_view name) {
  return taskNamed<AimedKickTask>(name);
}

}  // namespace nonet::lab
