// goToTarget: the walk set on the whole course (AAMAS 2012, section 4.2).
#include "nonet/lab/target_course.h"

#include "tasks.h"

namespace nonet::lab {

namespace {

class GoToTargetTask final : public Task {
 public:
  std::string_view name() const override { return "goToTarget"; }
  std::string_view description() const override {
    return "walk the obstacle course with the goToTarget set: fast, agile, without falls";
  }
  std::vector<std::string> searchedKeys() const override { return {"motion.walk."}; }

  TaskResult evaluate(const agent::AgentParameters& parameters, std::uint64_t seed,
                      const TaskSettings& settings) const override {
    CourseOptions options;
    options.set = motion::WalkSet::GoToTarget;
    return courseTask(parameters, seed, settings, options);
  }
};

}  // namespace

const Task& goToTargetTask() {
  static const GoToTargetTask task;
  return task;
}

}  // namespace nonet::lab
