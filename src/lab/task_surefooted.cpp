// surefooted: the last polish of a walk set. The course of goToTarget with light pushes, as one's own
// missteps and the ball give them, where a fall costs four times as much.
#include "nonet/lab/target_course.h"

#include "tasks.h"

namespace nonet::lab {

namespace {

constexpr double kFallCost = 20.0;
constexpr double kPush = 0.15;  // m/s

class SurefootedTask final : public Task {
 public:
  std::string_view name() const override { return "surefooted"; }
  std::string_view description() const override {
    return "the course of goToTarget with light pushes; a fall costs 20 instead of 5";
  }
  std::vector<std::string> searchedKeys() const override { return {"motion.walk."}; }

  TaskResult evaluate(const agent::AgentParameters& parameters, std::uint64_t seed,
                      const TaskSettings& settings) const override {
    CourseOptions options;
    options.set = motion::WalkSet::GoToTarget;
    options.fallCost = kFallCost;
    options.push = kPush;
    return courseTask(parameters, seed, settings, options);
  }
};

}  // namespace

const Task& surefootedTask() {
  static const SurefootedTask task;
  return task;
}

}  // namespace nonet::lab
