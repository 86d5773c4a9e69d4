// duel: the course of goToTarget among others who bump into the robot, and staying upright before all.
#include "nonet/lab/target_course.h"

#include "tasks.h"

namespace nonet::lab {

namespace {

constexpr double kFallCost = 20.0;  // rising takes two seconds, in which others have the ball
constexpr double kPush = 0.4;       // m/s

class DuelTask final : public Task {
 public:
  std::string_view name() const override { return "duel"; }
  std::string_view description() const override {
    return "the course of goToTarget with pushes as in a crowd; a fall costs 20 instead of 5";
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

const Task& duelTask() {
  static const DuelTask task;
  return task;
}

}  // namespace nonet::lab
