// The list of tasks and what they share.
#pragma once

#include "nonet/lab/robot_trial.h"
#include "nonet/lab/target_course.h"
#include "nonet/lab/task.h"

namespace nonet::lab {

const Task& goToTargetTask();
const Task& surefootedTask();
const Task& duelTask();
const Task& sprintTask();
const Task& getupTask();
const Task& getupFrontTask();
const Task& getupBackTask();
const Task& kickTask();
const Task& diveTask();
const Task& quadraticTask();

TrialSetup trialSetup(const agent::AgentParameters& parameters, std::uint64_t seed,
                      const TaskSettings& settings);

/// Where the search for a walk set begins: at `walk`, unless the set was learned before.
void startAt(const motion::WalkParameters& walk, motion::WalkParameters& set);

/// The course as a task.
TaskResult courseTask(const agent::AgentParameters& parameters, std::uint64_t seed,
                      const TaskSettings& settings, CourseOptions options);

}  // namespace nonet::lab
