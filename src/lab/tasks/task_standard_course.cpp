// standardCourse: what `nonet walk-report --courses` measures, in one number. It fits the walk set to the
// frozen others.
#include "nonet/lab/trial/target_course.h"

#include "lab/tasks/tasks.h"

namespace nonet::lab {

namespace {

constexpr double kUnsteadinessCost = 1.0;
constexpr double kGivenUp = 300.0;  // s, for a course that was left after the last fall

}  // namespace

TaskResult TimedCourseTask::evaluate(const agent::AgentParameters& parameters, std::uint64_t seed,
                                     const TaskSettings& settings) const {
  const TrialSettings setup = trialSettings(parameters, seed, settings);
  const auto walk = [&](bool untilReached, bool changeSets) {
    CourseSettings way = course();
    way.untilReached = untilReached;
    way.changeSets = changeSets;
    return runCourse(setup, seed, way);
  };
  const CourseResult timed = walk(true, false);
  const CourseResult limited = walk(false, false);
  const CourseResult changing = walk(false, true);
  // The farther it came, the better.
  const double time = timed.falls < kMostFalls ? timed.time : kGivenUp - timed.distance;
  const int falls = timed.falls + limited.falls + changing.falls;
  const double unsteadiness = timed.unsteadiness + limited.unsteadiness + changing.unsteadiness;
  return {.fitness = -time - kDearFall * falls - kUnsteadinessCost * unsteadiness,
          .measures = {{"time_s", timed.time},
                       {"falls", timed.falls},
                       {"falls_limited", limited.falls},
                       {"falls_changing", changing.falls},
                       {"unsteadiness_s", unsteadiness},
                       {"reward", limited.reward}}};
}

const Task& standardCourseTask() {
  static const TimedCourseTask task(
      "standardCourse",
      "the time for the course of goToTarget, walked with all sets; a fall there, within its time "
      "limits or while sets change costs 20 s, near falls cost too",
      "motion.walk.", CourseSettings::Items::All);
  return task;
}

}  // namespace nonet::lab
