// heldHeading: standardCourse's way to measure, but only the sidesteps and backward steps with a held
// heading, where a walk is slowest, and only the parameters that matter there. A quarter of the whole course,
// and a search among a dozen parameters.
#include "nonet/lab/target_course.h"

#include "tasks.h"

namespace nonet::lab {

const Task& heldHeadingTask() {
  static const TimedCourseTask task(
      "heldHeading", "as standardCourse, but only what is walked sideways and backward with a held heading",
      {"motion.walk.maxStepXBack", "motion.walk.maxStepY", "motion.walk.deltaStepY", "motion.walk.maxChangeY",
       "motion.walk.brake", "motion.walk.xFactorBack", "motion.walk.yFactor",
       "motion.walk.torsoPitchStepBack", "motion.walk.torsoRollStep", "motion.walk.accelerationShiftY",
       "motion.walk.accelerationRoll", "motion.walk.sideOut"},
      CourseOptions::Items::HeldHeading);
  return task;
}

}  // namespace nonet::lab
