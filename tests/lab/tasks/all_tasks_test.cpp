// Every task that `nonet optimize --list` shows: the same seed gives the same value, and a robot that is
// crippled in what the task is to teach gets less.
#include <algorithm>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "nonet/agent/agent_setup.h"
#include "nonet/lab/tasks/task.h"

namespace nonet::lab {
namespace {

struct Case {
  std::string_view task;
  /// What cripples the robot: of the keys that the task moves.
  std::vector<std::string> crippled;
  /// That are tried: more where luck decides.
  int seeds = 1;

  friend void PrintTo(const Case& tried, std::ostream* out) { *out << tried.task; }
};

const std::vector<Case>& cases() {
  static const std::vector<Case> list{
      // Hardly walks.
      {"goToTarget", {"motion.walk.gait.maxStepX=0.02"}},
      {"surefooted", {"motion.walk.gait.maxStepX=0.02"}},
      {"standardCourse", {"motion.walk.gait.maxStepX=0.02"}},
      {"sidestep", {"motion.sidestep.gait.maxStepY=0.01"}},
      {"duel", {"motion.positioning.gait.maxStepX=0.02"}},
      {"sprint", {"motion.sprint.gait.stepHeight=0"}},
      {"run", {"motion.sprint.gait.maxStepX=0.02"}},
      {"chase", {"motion.sprint.gait.maxStepX=0.02"}},
      {"footwork", {"motion.positioning.gait.maxStepX=0.02"}},
      // Does not bend its hips when it should.
      {"getup", {"motion.skills.rise_front.hipPitch3=0"}},
      {"getup_front", {"motion.skills.rise_front.hipPitch3=0"}},
      {"getup_back", {"motion.skills.rise_back.hipPitch4=0"}},
      // Kicks where the ball is not.
      {"kick_power", {"motion.skills.kick_power.ahead=0.34"}},
      {"played_power", {"motion.skills.kick_power.ahead=0.34"}},
      {"aimed_power", {"motion.skills.kick_power.ahead=0.34"}},
      // Is late, or does not bend its legs.
      {"dive", {"motion.skills.dive.time1=0.5", "motion.skills.dive.time2=0.04"}, 4},
      {"block", {"motion.skills.block.hipPitchLeft1=-0.4", "motion.skills.block.kneeLeft1=0"}},
      // Dives as soon as a ball comes.
      {"save",
       {"team.goalie.diveTime=5", "team.goalie.highDiveTime=5", "team.goalie.diveReach=0",
        "team.goalie.diveFarthest=3"},
       2},
      // The last steps take forever.
      {"approach", {"motion.kick.mostSpeed=0.1"}, 2},
      {"dribble", {"team.dribble.contact=0"}, 2},
      // Goes to the ball instead of awaiting it.
      {"receive", {"team.receive.speed=5"}, 4},
      // Keeps away from the ball.
      {"contest", {"team.ball.behindBall=1"}},
  };
  return list;
}

/// Listed, but not here: swing_power begins with 1280 whole approaches, for twenty seconds; four scrums and
/// ten attacks, of six and four whole robots, take two seconds and more each of the three times. Tests of
/// lab/trial run a few of each.
const std::vector<std::string_view> kTooLong{"swing_power", "scrum", "attack"};

class EveryTask : public testing::TestWithParam<Case> {
 protected:
  static constexpr int kType = 2;

  static const Task& task() { return findTask(GetParam().task); }
  static agent::AgentParameters robot(const std::vector<std::string>& assignments) {
    agent::AgentChoice choice;
    choice.robotType = kType;
    choice.assignments = assignments;
    agent::AgentParameters parameters = agent::makeAgentSettings(choice, NONET_SOURCE_DIR).parameters;
    task().prepare(parameters);
    return parameters;
  }
  static double fitness(const agent::AgentParameters& parameters, std::uint64_t seed) {
    const TaskSettings settings{.robotType = kType, .quickSolver = true, .dataFolder = NONET_SOURCE_DIR};
    return task().evaluate(parameters, seed, settings).fitness;
  }
};

TEST_P(EveryTask, GivesTheSameForASeedAndLessForACrippledRobot) {
  const agent::AgentParameters shipped = robot({});
  const agent::AgentParameters crippled = robot(GetParam().crippled);
  const double first = fitness(shipped, 1);
  EXPECT_EQ(first, fitness(shipped, 1));
  double all = first;
  double allOfCrippled = fitness(crippled, 1);
  for (int seed = 2; seed <= GetParam().seeds; ++seed) {
    all += fitness(shipped, static_cast<std::uint64_t>(seed));
    allOfCrippled += fitness(crippled, static_cast<std::uint64_t>(seed));
  }
  EXPECT_LT(allOfCrippled, all) << "the fitness of " << GetParam().seeds << " seeds";
}

TEST_P(EveryTask, IsCrippledInWhatItMoves) {
  const std::vector<std::string> keys = task().searchedKeys();
  for (const std::string& assignment : GetParam().crippled) {
    EXPECT_TRUE(std::any_of(keys.begin(), keys.end(), [&](const std::string& key) {
      return assignment.starts_with(key);
    })) << assignment;
  }
}

INSTANTIATE_TEST_SUITE_P(Tasks, EveryTask, testing::ValuesIn(cases()),
                         [](const auto& info) { return std::string(info.param.task); });

TEST(TaskList, IsTriedUnlessATaskTakesTooLong) {
  std::vector<std::string_view> listed;
  for (const Task* task : registeredTasks())
    if (!task->hidden()) listed.push_back(task->name());
  std::vector<std::string_view> tried = kTooLong;
  for (const Case& tryOut : cases()) tried.push_back(tryOut.task);
  EXPECT_THAT(tried, testing::UnorderedElementsAreArray(listed));
}

}  // namespace
}  // namespace nonet::lab
