#include <array>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "nonet/agent/agent_setup.h"
#include "nonet/config/parameters.h"

#include "lab/tasks/tasks.h"

namespace nonet::lab {

namespace {

// A task for every kick: prefix_NAME.
struct NamedTasks {
  std::string_view prefix;
  const Task& (*task)(std::string_view name);
};
constexpr NamedTasks kOfAKick[] = {
    {"swing_", swingTask}, {"played_", playedKickTask}, {"aimed_", aimedKickTask}};

}  // namespace

std::span<const Task* const> registeredTasks() {
  static const std::array tasks{
      &goToTargetTask(),
      &surefootedTask(),
      &standardCourseTask(),
      &sidestepTask(),
      &duelTask(),
      &sprintTask(),
      &runTask(),
      &chaseTask(),
      &getupTask(),
      &getupFrontTask(),
      &getupBackTask(),
      &swingTask("power"),
      &kickTask("kick_power"),
      &playedKickTask("power"),
      &aimedKickTask("power"),
      &diveTask(),
      &blockTask(),
      &saveTask(),
      &approachTask(),
      &footworkTask(),
      &dribbleTask(),
      &receiveTask(),
      &contestTask(),
      &scrumTask(),
      &attackTask(),
      &quadraticTask(),
  };
  return tasks;
}

const Task& findTask(std::string_view name) {
  if (name.starts_with("kick_")) return kickTask(name);
  for (const NamedTasks& kind : kOfAKick) {
    if (name.starts_with(kind.prefix)) return kind.task(name.substr(kind.prefix.size()));
  }
  std::string known;
  for (const Task* task : registeredTasks()) {
    if (task->name() == name) return *task;
    if (!task->hidden()) known += fmt::format("{}{}", known.empty() ? "" : ", ", task->name());
  }
  throw std::runtime_error(fmt::format("unknown task '{}': use one of {}", name, known));
}

TrialSettings trialSettings(const agent::AgentParameters& parameters, std::uint64_t seed,
                            const TaskSettings& settings) {
  TrialSettings setup;
  setup.robotType = settings.robotType;
  setup.motion = parameters.motion;
  setup.world = parameters.world;
  setup.skillFolder = settings.dataFolder + "/skills";
  setup.seed = seed;
  setup.physics.solver =
      settings.quickSolver ? sim::WorldSettings::Solver::Quick : sim::WorldSettings::Solver::Exact;
  return setup;
}

agent::AgentSettings agentOf(const agent::AgentParameters& parameters, const TaskSettings& settings) {
  agent::AgentSettings agent;
  agent.robotType = settings.robotType;
  agent.parameters = parameters;
  agent.skillFolder = settings.dataFolder + "/skills";
  return agent;
}

agent::AgentSettings dataAgent(const TaskSettings& settings, int robotType) {
  agent::AgentChoice choice;
  choice.robotType = robotType;
  return agent::makeAgentSettings(choice, settings.dataFolder);
}

sim::Settings serverOf(const TaskSettings& settings) {
  sim::Settings server;
  server.quickSolver = settings.quickSolver;
  return server;
}

void startAt(const motion::WalkParameters& walk, motion::WalkParameters& set) {
  motion::WalkParameters untouched;
  if (config::toToml(set) == config::toToml(untouched)) set = walk;
}

CourseTask::CourseTask(std::string_view name, std::string_view description, std::string_view key,
                       const CourseSettings& course)
    : name_(name), description_(description), key_(key), course_(course) {
  course_.mostFalls = kMostFalls;
}

TaskResult CourseTask::evaluate(const agent::AgentParameters& parameters, std::uint64_t seed,
                                const TaskSettings& settings) const {
  const CourseResult course = runCourse(trialSettings(parameters, seed, settings), seed, course_);
  return {.fitness = course.reward,
          .measures = {{"falls", course.falls},
                       {"targets", course.targets},
                       {"reached", course.reached},
                       {"distance_m", course.distance},
                       {"time_s", course.time},
                       {"stopDrift_m", course.stopDrift}}};
}

}  // namespace nonet::lab
