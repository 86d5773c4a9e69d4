// dive, block: what share of the shots beside it the goalie bars in time; and that it rises afterwards.
#include <algorithm>

#include "nonet/lab/trial/dive_trial.h"
#include "nonet/math/random.h"

#include "lab/tasks/tasks.h"

namespace nonet::lab {

namespace {

constexpr std::uint64_t kDiveDraws = 7;  // stream of what this task draws

constexpr double kFailure = 0.1;      // of the share that a failed first attempt to rise costs
constexpr double kPerSecond = 0.005;  // of the share per second of rising
constexpr double kLow = 0.7;          // weight of shots along the ground

// Of the balls that pass at any of the places and times, those that are barred. A flying ball may be timed:
// once the robot is there, later balls are met by diving later.
double sharedBarred(const Dive& dive, std::size_t height, int firstPlace, int lastPlace) {
  int met = 0;
  int all = 0;
  for (int place = firstPlace; place <= lastPlace; ++place) {
    bool before = false;
    for (int time = 0; time < Dive::kTimes; ++time) {
      const bool now = dive.barred[static_cast<std::size_t>(time)][height][static_cast<std::size_t>(place)];
      before = now || (before && height > 0);
      met += before ? 1 : 0;
      ++all;
    }
  }
  return static_cast<double>(met) / all;
}

class DiveTask final : public Task {
 public:
  DiveTask(std::string_view name, std::string_view key, std::string_view description, int firstPlace,
           int lastPlace)
      : name_(name), key_(key), description_(description), firstPlace_(firstPlace), lastPlace_(lastPlace) {}

  std::string_view name() const override { return name_; }
  std::string_view description() const override { return description_; }
  std::vector<std::string> searchedKeys() const override { return {std::string(key_)}; }

  TaskResult evaluate(const agent::AgentParameters& parameters, std::uint64_t seed,
                      const TaskSettings& settings) const override {
    const TrialSettings setup = trialSettings(parameters, seed, settings);
    Random random = Random(seed).fork(kDiveDraws);
    double low = 0.0;
    double high = 0.0;
    double time = 0.0;
    double failures = 0.0;
    for (const model::Side side : {model::Side::Left, model::Side::Right}) {
      const Dive dive = diveAndRise(setup, name_, side, random.next());
      low += 0.5 * sharedBarred(dive, 0, firstPlace_, lastPlace_);
      for (const std::size_t height : {std::size_t{1}, std::size_t{2}})
        high += 0.25 * sharedBarred(dive, height, firstPlace_, lastPlace_);
      time += 0.5 * dive.riseTime;
      failures += dive.stands && dive.attempts <= 1 ? 0.0 : 0.5;
    }
    return {.fitness = kLow * low + (1.0 - kLow) * high - kFailure * failures - kPerSecond * time,
            .measures = {{"low", low}, {"high", high}, {"rise_s", time}, {"failures", failures}}};
  }

 private:
  std::string_view name_;
  std::string_view key_;
  std::string_view description_;
  int firstPlace_;
  int lastPlace_;
};

}  // namespace

const Task& diveTask() {
  static const DiveTask task("dive", "motion.skills.dive.",
                             "the goalie's dive: shots barred 0.15 to 0.8 m aside, and rising from it", 3,
                             16);
  return task;
}

const Task& blockTask() {
  static const DiveTask task("block", "motion.skills.block.",
                             "the goalie's block: shots barred up to 0.35 m aside, and rising from it", 0, 7);
  return task;
}

}  // namespace nonet::lab
