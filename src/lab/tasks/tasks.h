// The list of tasks and what they share.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "nonet/lab/tasks/task.h"
#include "nonet/lab/trial/robot_trial.h"
#include "nonet/lab/trial/target_course.h"
#include "nonet/sim/settings/settings.h"

namespace nonet::lab {

const Task& goToTargetTask();
const Task& surefootedTask();
const Task& standardCourseTask();
const Task& sidestepTask();
const Task& duelTask();
const Task& sprintTask();
const Task& runTask();
const Task& chaseTask();
const Task& getupTask();
const Task& getupFrontTask();
const Task& getupBackTask();
/// The task for the kick with this name (any skill with the head of a kick; they all begin with "kick_").
const Task& kickTask(std::string_view name);
/// The kick kick_NAME with the ball as play leaves it.
const Task& playedKickTask(std::string_view name);
const Task& aimedKickTask(std::string_view name);
/// "power": the same kick from the moment it begins.
const Task& swingTask(std::string_view name);
const Task& diveTask();
const Task& approachTask();
const Task& footworkTask();
const Task& dribbleTask();
const Task& receiveTask();
const Task& contestTask();
const Task& scrumTask();
const Task& attackTask();
const Task& blockTask();
const Task& saveTask();
const Task& quadraticTask();

TrialSettings trialSettings(const agent::AgentParameters& parameters, std::uint64_t seed,
                            const TaskSettings& settings);

/// The whole agent of a game's task, and the server it plays on.
agent::AgentSettings agentOf(const agent::AgentParameters& parameters, const TaskSettings& settings);
/// The same of this type as the data folder has it: opponents, and robots that begin a stored start.
agent::AgentSettings dataAgent(const TaskSettings& settings, int robotType);
sim::Settings serverOf(const TaskSettings& settings);

/// Where the search for a walk set begins: at `walk`, unless the set was learned before.
void startAt(const motion::WalkParameters& walk, motion::WalkParameters& set);

// Who falls so often on a course learns nothing from the rest, and falls take long to simulate.
constexpr int kMostFalls = 4;

// A fall costs four times what it costs on the course of goToTarget: rising takes two seconds, in which
// others have the ball, and most falls happen where a sprint ends, too few to be felt at 5.
constexpr double kDearFall = 20.0;
constexpr double kLightPush = 0.15;  // m/s, as one's own missteps and the ball give them
constexpr double kDuelPush = 0.4;    // m/s, as others give them at a contested ball

/// How the task duel walks its course.
CourseSettings duelCourse();

/// The obstacle course as a task: one way to walk it, and the set that is learned on it.
class CourseTask : public Task {
 public:
  /// `key`: the prefix of the parameters to move. The texts must outlive the task.
  CourseTask(std::string_view name, std::string_view description, std::string_view key,
             const CourseSettings& course);

  std::string_view name() const override { return name_; }
  std::string_view description() const override { return description_; }
  std::vector<std::string> searchedKeys() const override { return {std::string(key_)}; }
  TaskResult evaluate(const agent::AgentParameters& parameters, std::uint64_t seed,
                      const TaskSettings& settings) const override;

 protected:
  const CourseSettings& course() const { return course_; }

 private:
  std::string_view name_;
  std::string_view description_;
  std::string_view key_;
  CourseSettings course_;
};

/// The time for the course with the sets that the agent itself would choose. The course is walked three
/// times: by the clock, every target walked to until it is reached; with goToTarget's time limits, so that
/// commands change before they are carried out; and with sets that change at random. Light pushes keep the
/// learned set surefooted; a fall costs 20 s, near falls cost too.
class TimedCourseTask : public CourseTask {
 public:
  TimedCourseTask(std::string_view name, std::string_view description, std::string_view key,
                  CourseSettings::Items items)
      : CourseTask(name, description, key, {.items = items, .push = kLightPush}) {}

  TaskResult evaluate(const agent::AgentParameters& parameters, std::uint64_t seed,
                      const TaskSettings& settings) const override;
};

}  // namespace nonet::lab
