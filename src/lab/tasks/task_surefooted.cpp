// surefooted: the last polish of a walk set. The course of goToTarget with light pushes, as one's own
// missteps and the ball give them, where a fall costs four times as much.
#include "nonet/lab/trial/target_course.h"

#include "lab/tasks/tasks.h"

namespace nonet::lab {

const Task& surefootedTask() {
  static const CourseTask task(
      "surefooted", "the course of goToTarget with light pushes; a fall costs 20 instead of 5",
      "motion.walk.", {.set = motion::WalkSet::GoToTarget, .fallCost = kDearFall, .push = kLightPush});
  return task;
}

}  // namespace nonet::lab
