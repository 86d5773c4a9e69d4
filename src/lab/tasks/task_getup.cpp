// getup: rising from the seeded falls of `nonet rise-report`. getup_front and getup_back fall to one side
// only, so that each skill can be learned by itself.
#include <cmath>

#include "nonet/lab/trial/rise_trial.h"
#include "nonet/math/random.h"

#include "lab/tasks/tasks.h"

namespace nonet::lab {

namespace {

constexpr std::uint64_t kGetupDraws = 4;  // stream of what this task draws

constexpr int kFallsOfAKind = 2;
constexpr int kMostTries = 4;           // to fall as wanted
constexpr double kSecondAttempt = 3.0;  // s, added when the first attempt failed
constexpr double kFailure = 12.0;       // s, for never standing
// The referee freezes limbs that collide for a second, here nobody does; more for longer, so that a search
// finds out of it.
constexpr double kSelfCollision = 2.0;  // s
constexpr double kPerSecondOfCollision = 3.0;

class GetupTask final : public Task {
 public:
  GetupTask(std::string_view name, std::string_view description, std::vector<std::string> keys,
            std::vector<FallKind> kinds)
      : name_(name), description_(description), keys_(std::move(keys)), kinds_(std::move(kinds)) {}

  std::string_view name() const override { return name_; }
  std::string_view description() const override { return description_; }
  std::vector<std::string> searchedKeys() const override { return keys_; }

  TaskResult evaluate(const agent::AgentParameters& parameters, std::uint64_t seed,
                      const TaskSettings& settings) const override {
    const TrialSettings setup = trialSettings(parameters, seed, settings);
    Random random = Random(seed).fork(kGetupDraws);
    double cost = 0.0;
    double time = 0.0;
    int firstTries = 0;
    int collisions = 0;
    const int falls = kFallsOfAKind * static_cast<int>(kinds_.size());
    for (int i = 0; i < falls; ++i) {
      const Rise rise = fallAs(kinds_[static_cast<std::size_t>(i / kFallsOfAKind)], setup, random);
      const bool first = rise.stands && rise.attempts <= 1;
      firstTries += first ? 1 : 0;
      time += rise.time;
      cost += (rise.stands ? rise.time : kFailure) + (first ? 0.0 : kSecondAttempt);
      if (rise.collided <= 0.0) continue;
      ++collisions;
      cost += kSelfCollision + kPerSecondOfCollision * rise.collided;
    }
    return {.fitness = -cost / falls,
            .measures = {{"first_try", static_cast<double>(firstTries) / falls},
                         {"time_s", time / falls},
                         {"self_collisions", static_cast<double>(collisions) / falls}}};
  }

 private:
  static Rise fallAs(FallKind kind, const TrialSettings& setup, Random& random) {
    Rise rise;
    for (int i = 0; i < kMostTries && !rise.fell; ++i) rise = fallAndRise(setup, kind, random.next());
    return rise;
  }

  std::string_view name_;
  std::string_view description_;
  std::vector<std::string> keys_;
  std::vector<FallKind> kinds_;
};

}  // namespace

const Task& getupTask() {
  static const GetupTask task("getup",
                              "rise after falls to the front, the back and the side: fast and always",
                              {"motion.skills.rise_"}, {FallKind::Front, FallKind::Back, FallKind::Side});
  return task;
}

const Task& getupFrontTask() {
  static const GetupTask task("getup_front", "rise after falls to the front", {"motion.skills.rise_front."},
                              {FallKind::Front});
  return task;
}

const Task& getupBackTask() {
  static const GetupTask task("getup_back", "rise after falls to the back", {"motion.skills.rise_back."},
                              {FallKind::Back});
  return task;
}

}  // namespace nonet::lab
