// standardCourse: the course of goToTarget by the clock, as `nonet walk-report --courses` times it: every
// target is walked to until it is reached, with the set that the agent itself would choose. It fits the walk
// set to the frozen others. Light pushes keep it surefooted.
#include "nonet/lab/target_course.h"

#include "tasks.h"

namespace nonet::lab {

namespace {

constexpr double kFallCost = 20.0;  // s
constexpr double kGivenUp = 300.0;  // s, for a course that was left after the last fall

class StandardCourseTask final : public CourseTask {
 public:
  using CourseTask::CourseTask;

 protected:
  double fitness(const CourseResult& course) const override {
    if (course.falls >= mostFalls()) return course.distance - kGivenUp;
    return -course.time - kFallCost * course.falls;
  }
};

}  // namespace

const Task& standardCourseTask() {
  static const StandardCourseTask task(
      "standardCourse", "the time for the course of goToTarget, walked with all sets; a fall costs 20 s",
      "motion.walk.", {.untilReached = true, .push = kLightPush});
  return task;
}

}  // namespace nonet::lab
