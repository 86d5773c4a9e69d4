// goToTarget: the walk set on the whole course [MacAlpine 2012a, section 4.2].
#include "nonet/lab/trial/target_course.h"

#include "lab/tasks/tasks.h"

namespace nonet::lab {

const Task& goToTargetTask() {
  static const CourseTask task("goToTarget",
                               "walk the obstacle course with the goToTarget set: fast, agile, without falls",
                               "motion.walk.", {.set = motion::WalkSet::GoToTarget});
  return task;
}

}  // namespace nonet::lab
