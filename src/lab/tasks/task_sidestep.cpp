// sidestep: standardCourse's way to measure, but only the legs sideways and backward with a held heading,
// where walks are slowest: a quarter of the whole course. The sidestep set is learned there, beside the
// others as they are.
#include "nonet/lab/trial/target_course.h"

#include "lab/tasks/tasks.h"

namespace nonet::lab {

namespace {

class SidestepTask final : public TimedCourseTask {
 public:
  using TimedCourseTask::TimedCourseTask;

  // The search begins at the walk set, unless a sidestep set was learned before.
  void prepare(agent::AgentParameters& parameters) const override {
    parameters.motion.selection.useSidestep = true;
    startAt(parameters.motion.sets.goToTarget, parameters.motion.sets.sidestep);
  }
};

}  // namespace

const Task& sidestepTask() {
  static const SidestepTask task(
      "sidestep", "as standardCourse, but only what is walked sideways and backward with a held heading",
      "motion.sidestep.", CourseSettings::Items::HeldHeading);
  return task;
}

}  // namespace nonet::lab
