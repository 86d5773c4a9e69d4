// sprint: the same course with the goToTarget set as it is; the sprint set takes over when the target lies
// straight ahead [MacAlpine 2012a, section 4.2], so learning it includes the changes between the two.
#include "nonet/lab/trial/target_course.h"

#include "lab/tasks/tasks.h"

namespace nonet::lab {

namespace {

class SprintTask final : public CourseTask {
 public:
  using CourseTask::CourseTask;

  // The search begins at the walk set, unless a sprint set was learned before.
  void prepare(agent::AgentParameters& parameters) const override {
    parameters.motion.selection.useSprint = true;
    startAt(parameters.motion.sets.goToTarget, parameters.motion.sets.sprint);
  }
};

}  // namespace

const Task& sprintTask() {
  static const SprintTask task("sprint",
                               "the course with the goToTarget set frozen; the sprint set runs straight "
                               "ahead; a fall costs 20 instead of 5",
                               "motion.sprint.", {.fallCost = kDearFall});
  return task;
}

}  // namespace nonet::lab
