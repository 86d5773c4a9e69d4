#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "nonet/agent/agent_setup.h"
#include "nonet/lab/tasks/task.h"

namespace nonet::lab {
namespace {

constexpr int kType = 2;

TaskResult kickedFour(const std::string& task) {
  agent::AgentChoice choice;
  choice.robotType = kType;
  const TaskSettings settings{.robotType = kType, .quickSolver = true, .dataFolder = NONET_SOURCE_DIR};
  return findTask(task).evaluate(agent::makeAgentSettings(choice, NONET_SOURCE_DIR).parameters, 3, settings);
}

// Of four kicks one at a ball that rests in either task: the others roll differently.
TEST(KickTasks, AKickAsPlayedIsTheSameKickAtOtherBalls) {
  const Task& played = findTask("played_quick");
  EXPECT_EQ(played.name(), "played_quick");
  EXPECT_EQ(played.searchedKeys(), findTask("kick_quick").searchedKeys());
  const TaskResult once = kickedFour("played_quick");
  EXPECT_EQ(once.fitness, kickedFour("played_quick").fitness);
  EXPECT_NE(once.fitness, kickedFour("kick_quick").fitness);
  ASSERT_EQ(once.measures.front().first, "distance_m");
  EXPECT_GT(once.measures.front().second, 2.0);
}

double measure(const TaskResult& result, const std::string& name) {
  for (const auto& [key, value] : result.measures) {
    if (key == name) return value;
  }
  ADD_FAILURE() << "no measure " << name;
  return 0.0;
}

// Without a failure the two differ by three times what goes aside.
TEST(KickTasks, AnAimedKickPaysFourTimesForWhatGoesAside) {
  EXPECT_EQ(findTask("aimed_power").name(), "aimed_power");
  const TaskResult played = kickedFour("played_power");
  const TaskResult aimed = kickedFour("aimed_power");
  ASSERT_EQ(measure(played, "failures"), 0.0);
  ASSERT_GT(measure(played, "aside_m"), 0.0);
  EXPECT_EQ(measure(aimed, "aside_m"), measure(played, "aside_m"));
  EXPECT_NEAR(aimed.fitness, played.fitness - 3.0 * measure(played, "aside_m"), 1e-9);
}

TEST(KickTasks, NeedAKick) {
  for (const char* task : {"kick_nothing", "played_nothing", "aimed_nothing"})
    EXPECT_THROW(kickedFour(task), std::runtime_error) << task;
}

}  // namespace
}  // namespace nonet::lab
