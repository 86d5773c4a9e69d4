#include <array>
#include <stdexcept>

#include <fmt/format.h>

#include "nonet/config/parameters.h"

#include "tasks.h"

namespace nonet::lab {

std::span<const Task* const> registeredTasks() {
  static const std::array<const Task*, 10> tasks{
      &goToTargetTask(), &surefootedTask(), &duelTask(), &sprintTask(), &getupTask(),
      &getupFrontTask(), &getupBackTask(),  &kickTask(), &diveTask(),   &quadraticTask()};
  return tasks;
}

const Task& findTask(std::string_view name) {
  std::string known;
  for (const Task* task : registeredTasks()) {
    if (task->name() == name) return *task;
    if (!task->hidden()) known += fmt::format("{}{}", known.empty() ? "" : ", ", task->name());
  }
  throw std::runtime_error(fmt::format("unknown task '{}': use one of {}", name, known));
}

TrialSetup trialSetup(const agent::AgentParameters& parameters, std::uint64_t seed,
                      const TaskSettings& settings) {
  TrialSetup setup;
  setup.robotType = settings.robotType;
  setup.motion = parameters.motion;
  setup.world = parameters.world;
  setup.skillFolder = settings.dataFolder + "/skills";
  setup.seed = seed;
  setup.physics.solver =
      settings.quickSolver ? sim::WorldSettings::Solver::Quick : sim::WorldSettings::Solver::Exact;
  return setup;
}

void startAt(const motion::WalkParameters& walk, motion::WalkParameters& set) {
  motion::WalkParameters untouched;
  if (config::toToml(set) == config::toToml(untouched)) set = walk;
}

TaskResult courseTask(const agent::AgentParameters& parameters, std::uint64_t seed,
                      const TaskSettings& settings, CourseOptions options) {
  // Who falls so often learns nothing from the rest, and falls take long to simulate.
  options.mostFalls = 4;
  const CourseResult course = runCourse(trialSetup(parameters, seed, settings), seed, options);
  return {.fitness = course.reward,
          .measures = {{"falls", course.falls},
                       {"targets", course.targets},
                       {"reached", course.reached},
                       {"distance_m", course.distance},
                       {"time_s", course.time},
                       {"stopDrift_m", course.stopDrift}}};
}

}  // namespace nonet::lab
