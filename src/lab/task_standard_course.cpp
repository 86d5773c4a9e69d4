// standardCourse: what `nonet walk-report --courses` measures, in one number. The course of goToTarget is
// walked three times with the sets that the agent itself would choose: by the clock, every target walked to
// until it is reached; with goToTarget's time limits, so that commands change before they are carried out;
// and with sets that change at random. It fits the walk set to the frozen others. Light pushes keep it
// surefooted.
#include "nonet/lab/target_course.h"

#include "tasks.h"

namespace nonet::lab {

namespace {

constexpr double kFallCost = 20.0;  // s
constexpr double kUnsteadinessCost = 1.0;
constexpr double kGivenUp = 300.0;  // s, for a course that was left after the last fall

class StandardCourseTask final : public Task {
 public:
  std::string_view name() const override { return "standardCourse"; }
  std::string_view description() const override {
    return "the time for the course of goToTarget, walked with all sets; a fall there, within its time "
           "limits or while sets change costs 20 s, near falls cost too";
  }
  std::vector<std::string> searchedKeys() const override { return {"motion.walk."}; }

  TaskResult evaluate(const agent::AgentParameters& parameters, std::uint64_t seed,
                      const TaskSettings& settings) const override {
    const TrialSetup setup = trialSetup(parameters, seed, settings);
    const auto walk = [&](bool untilReached, bool changeSets) {
      return runCourse(setup, seed,
                       {.mostFalls = kMostFalls,
                        .untilReached = untilReached,
                        .push = kLightPush,
                        .changeSets = changeSets});
    };
    const CourseResult timed = walk(true, false);
    const CourseResult limited = walk(false, false);
    const CourseResult changing = walk(false, true);
    // The farther it came, the better.
    const double time = timed.falls < kMostFalls ? timed.time : kGivenUp - timed.distance;
    const int falls = timed.falls + limited.falls + changing.falls;
    const double unsteadiness = timed.unsteadiness + limited.unsteadiness + changing.unsteadiness;
    return {.fitness = -time - kFallCost * falls - kUnsteadinessCost * unsteadiness,
            .measures = {{"time_s", timed.time},
                         {"falls", timed.falls},
                         {"falls_limited", limited.falls},
                         {"falls_changing", changing.falls},
                         {"unsteadiness_s", unsteadiness},
                         {"reward", limited.reward}}};
  }
};

}  // namespace

const Task& standardCourseTask() {
  static const StandardCourseTask task;
  return task;
}

}  // namespace nonet::lab
