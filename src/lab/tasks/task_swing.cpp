// swing_NAME: the kick kick_NAME from the moment it begins (swing_trial.h). For finding a kick's numbers
// before kick_NAME polishes them with the approach. The fitness is the distance towards the target less what
// goes aside, 1.2 m for every second until contact and what the robot leans afterwards, less half the spread
// over the starts; for a kick that goes as far as is asked for, the error counts instead of the distance, for
// a chip its height a metre on, and what it lands too far off; a kick that is to be low pays for height
// there. A ball that leaves by more than ten degrees gets less than -1, the less the farther off it is, so
// that a search finds to the direction; no contact is worse, a fall costs up to 1, and limbs that collide,
// which the referee would freeze, 1.
#include <cmath>
#include <map>
#include <mutex>
#include <string>
#include <tuple>

#include <fmt/format.h>

#include "nonet/lab/trial/swing_trial.h"
#include "nonet/math/angle.h"
#include "nonet/math/random.h"

#include "lab/tasks/kick_worth.h"
#include "lab/tasks/named_tasks.h"
#include "lab/tasks/tasks.h"

namespace nonet::lab {

namespace {

constexpr std::uint64_t kSwingDraws = 7;  // stream of what this task draws

constexpr int kStarts = 1280;        // that are stored: 320 are learned by heart
constexpr int kSwings = 8;           // a trial
constexpr double kPenalty = -1.0;    // m
constexpr double kNoContact = -3.0;  // m
constexpr double kPerTurn = 1.0;     // m, for a ball that goes the opposite way
constexpr double kPerSecond = 1.2;   // m/s
constexpr double kStraight = toRadians(10.0);
constexpr double kLeans = 0.3;         // rad, free
constexpr double kPerLean = 2.0;       // m/rad
constexpr double kLastsUpright = 1.5;  // s after contact: who falls later is nearer to standing
constexpr double kSpread = 0.5;        // share of the standard deviation
constexpr double kRolling = 0.3;       // m/s
// m from the ball: where the approach begins decides in which step the kick does.
constexpr double kNearest = 0.3;
constexpr double kFarthest = 3.0;
// Share of its bearing that every other approach has: in play most come from behind.
constexpr double kStraightOn = 0.2;
constexpr std::uint64_t kSeed = 26;  // of the starts
constexpr double kDistance = 10.0;   // m, that is asked of kicks that go always as far

using Starts = std::vector<KickStart>;

// How robots begin this kick with the values that the data folder has for it.
Starts makeStarts(const std::string& kick, const TaskSettings& settings) {
  const agent::AgentSettings agent = dataAgent(settings, settings.robotType);
  Starts starts;
  const Random seeds(kSeed);
  for (int i = 0; i < kStarts; ++i) {
    KickScene scene;
    scene.kick = kick;
    scene.bearing = (i % 2 == 0 ? 1.0 : kStraightOn) * kickBearing(i / 2);
    scene.rolling = i % 3 == 0 ? kRolling : 0.0;
    Random random = seeds.fork(static_cast<std::uint64_t>(i));
    scene.start = random.uniform(kNearest, kFarthest);
    if (auto start = kickStart(agent, serverOf(settings), scene, random.next()))
      starts.push_back(std::move(*start));
  }
  if (starts.empty()) throw std::runtime_error(fmt::format("no robot of this type comes to {}", kick));
  return starts;
}

double gained(const Swing& swing, const motion::KickHead& head, double distance) {
  const Kick& kick = swing.kick;
  if (!kick.contact) return kNoContact;
  const double off = std::abs(kick.direction());
  if (kick.missed() || off > kStraight) return kPenalty - kPerTurn * off / kPi;
  if (kick.selfCollided) return kPenalty;
  if (kick.fell) return kPenalty * (1.0 - std::min(1.0, swing.upright / kLastsUpright));
  return worthOfWay(kick, head, distance) - std::abs(kick.aside) - kPerSecond * kick.time -
         kPerLean * std::max(0.0, swing.lean - kLeans);
}

class SwingTask final : public Task {
 public:
  explicit SwingTask(const std::string& name) : name_("swing_" + name), kick_("kick_" + name) {}

  std::string_view name() const override { return name_; }
  std::string_view description() const override {
    return "a kick from the moment it begins: far, straight and without a fall";
  }
  std::vector<std::string> searchedKeys() const override { return {"motion.skills." + kick_ + "."}; }

  TaskResult evaluate(const agent::AgentParameters& parameters, std::uint64_t seed,
                      const TaskSettings& settings) const override {
    const agent::AgentSettings agent = agentOf(parameters, settings);
    SwingTrial trial(agent, kick_, settings.quickSolver);
    const Starts& starts = startsOf(settings);
    const motion::KickHead head = trial.head();
    Random random = Random(seed).fork(kSwingDraws);
    double sum = 0.0, squares = 0.0, distance = 0.0, speed = 0.0, falls = 0.0, failures = 0.0;
    for (int i = 0; i < kSwings; ++i) {
      const auto chosen = static_cast<std::size_t>(random.uniform() * static_cast<double>(starts.size()));
      const double asked = head.scales ? random.uniform(head.shortest, head.longest) : kDistance;
      const Swing swing = trial.run(starts[std::min(chosen, starts.size() - 1)], asked);
      const double value = gained(swing, head, asked);
      sum += value / kSwings;
      squares += value * value / kSwings;
      distance += swing.kick.forward / kSwings;
      speed += swing.kick.ballSpeed / kSwings;
      falls += swing.kick.fell ? 1.0 : 0.0;
      failures += value <= kPenalty ? 1.0 / kSwings : 0.0;
    }
    TaskResult result;
    result.fitness = sum - kSpread * std::sqrt(std::max(0.0, squares - sum * sum));
    result.measures = {
        {"distance_m", distance}, {"speed_mps", speed}, {"falls", falls}, {"failures", failures}};
    return result;
  }

 private:
  const Starts& startsOf(const TaskSettings& settings) const {
    const std::lock_guard lock(mutex_);
    const auto key = std::make_tuple(settings.robotType, settings.dataFolder);
    const auto found = starts_.find(key);
    if (found != starts_.end()) return found->second;
    return starts_.emplace(key, makeStarts(kick_, settings)).first->second;
  }

  std::string name_;
  std::string kick_;
  mutable std::mutex mutex_;
  mutable std::map<std::tuple<int, std::string>, Starts> starts_;
};

}  // namespace

const Task& swingTask(std::string_view name) {
  return taskNamed<SwingTask>(name);
}

}  // namespace nonet::lab
