#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "nonet/agent/agent_setup.h"
#include "nonet/lab/tasks/task.h"

namespace nonet::lab {
namespace {

constexpr int kType = 2;

TaskResult kickedFour(const std::string& task, std::uint64_t seed = 3) {
  agent::AgentChoice choice;
  choice.robotType = kType;
  const TaskSettings settings{.robotType = kType, .quickSolver = true, .dataFolder = NONET_SOURCE_DIR};
  return findTask(task).evaluate(agent::makeAgentSettings(choice, NONET_SOURCE_DIR).parameters, seed,
                                 settings);
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

double measured(const TaskResult& result, const std::string& name) {
  for (const auto& [key, value] : result.measures) {
    if (key == name) return value;
  }
  ADD_FAILURE() << "no measure " << name;
  return 0.0;
}

// Without a failure the two differ by three times what goes aside.
TEST(KickTasks, AnAimedKickPaysFourTimesForWhatGoesAside) {
  EXPECT_EQ(findTask("aimed_power").name(), "aimed_power");
  std::uint64_t seed = 1;
  while (measured(kickedFour("played_power", seed), "failures") > 0.0) ASSERT_LT(++seed, 20U);
  const TaskResult played = kickedFour("played_power", seed);
  const TaskResult aimed = kickedFour("aimed_power", seed);
  ASSERT_GT(measured(played, "aside_m"), 0.0);
  EXPECT_EQ(measured(aimed, "aside_m"), measured(played, "aside_m"));
  EXPECT_NEAR(aimed.fitness, played.fitness - 3.0 * measured(played, "aside_m"), 1e-9);
}

TEST(KickTasks, NeedAKick) {
  for (const char* task : {"kick_nothing", "played_nothing", "aimed_nothing"})
    EXPECT_THROW(kickedFour(task), std::runtime_error) << task;
}

}  // namespace
}  // namespace nonet::lab
