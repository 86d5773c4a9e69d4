// The obstacle course, and the tasks that score it. The oracles for the score are walks whose worth is plain:
// one target, steps on the spot, and nothing but falls.
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "nonet/lab/tasks/task.h"
#include "nonet/lab/trial/target_course.h"

namespace nonet::lab {
namespace {

agent::AgentParameters initialParameters() {
  agent::AgentParameters parameters;
  parameters.motion.skills = motion::declareSkillParameters(NONET_SOURCE_DIR "/skills");
  return parameters;
}

/// Whoever walks so falls at once: the feet are swung up to the hips.
agent::AgentParameters clumsyParameters() {
  agent::AgentParameters parameters = initialParameters();
  for (motion::WalkParameters* walk :
       {&parameters.motion.sets.goToTarget, &parameters.motion.sets.positioning}) {
    walk->gait.stepHeight = 0.25;
    walk->gait.maxStepX = 0.25;
  }
  return parameters;
}

/// Steps on the spot.
agent::AgentParameters lameParameters() {
  agent::AgentParameters parameters = initialParameters();
  for (motion::WalkParameters* walk :
       {&parameters.motion.sets.goToTarget, &parameters.motion.sets.positioning}) {
    walk->gait.maxStepX = walk->gait.maxStepXBack = walk->gait.maxStepY = walk->gait.maxStepTheta = 1e-4;
  }
  return parameters;
}

TaskSettings quickSettings() {
  return {.robotType = 0, .quickSolver = true, .dataFolder = NONET_SOURCE_DIR};
}

TrialSettings setupOf(const agent::AgentParameters& parameters, std::uint64_t seed) {
  TrialSettings setup;
  setup.motion = parameters.motion;
  setup.skillFolder = NONET_SOURCE_DIR "/skills";
  setup.seed = seed;
  setup.physics.solver = sim::WorldSettings::Solver::Quick;
  return setup;
}

double measure(const TaskResult& result, std::string_view name) {
  for (const auto& [key, value] : result.measures) {
    if (key == name) return value;
  }
  ADD_FAILURE() << "no measure " << name;
  return 0.0;
}

TEST(Course, EndsAfterSoManyItems) {
  constexpr std::uint64_t kCourse = 3;
  const std::vector<CourseItem> course = makeCourse(kCourse);
  int targets = 0;
  for (int items = 1; items <= 3; ++items) {
    for (const CourseLeg& leg : course[static_cast<std::size_t>(items) - 1].legs)
      targets += leg.kind == CourseLeg::Kind::Stop ? 0 : 1;
    CourseSettings settings;
    settings.mostItems = items;
    EXPECT_EQ(runCourse(setupOf(initialParameters(), kCourse), kCourse, settings).targets, targets);
  }
}

TEST(Course, HasEveryItemOnceInAnOrderOfItsSeed) {
  std::set<std::string> orders;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    std::set<std::string> names;
    std::string order;
    double time = 0.0;
    for (const CourseItem& item : makeCourse(seed)) {
      EXPECT_TRUE(names.insert(item.name).second) << item.name;
      order += item.name;
      for (const CourseLeg& leg : item.legs) time += leg.time;
    }
    EXPECT_EQ(names.size(), 12U);
    EXPECT_GT(time, 60.0);
    EXPECT_LT(time, 130.0);
    orders.insert(order);
  }
  EXPECT_GT(orders.size(), 18U);
}

TEST(Course, TheSameSeedGivesTheSameWalk) {
  const TrialSettings setup = setupOf(initialParameters(), 3);
  const CourseResult first = runCourse(setup, 3, {});
  const CourseResult second = runCourse(setup, 3, {});
  EXPECT_EQ(first.reward, second.reward);
  EXPECT_EQ(first.distance, second.distance);
  EXPECT_NE(first.reward, runCourse(setup, 4, {}).reward);
}

// It wanders off by more than half a field: goals, walls and the ball must be nowhere near, or it measures
// collisions.
TEST(Course, HasNothingToBumpInto) {
  TrialSettings small = setupOf(initialParameters(), 3);
  small.physics.fieldLength = 6.0;
  small.physics.fieldWidth = 4.0;
  const CourseResult inside = runCourse(small, 3, {});
  const CourseResult outside = runCourse(setupOf(initialParameters(), 3), 3, {});
  EXPECT_EQ(inside.reward, outside.reward);
  EXPECT_EQ(inside.unsteadiness, outside.unsteadiness);
}

TEST(Course, ByTheClockEveryTargetIsReached) {
  const CourseResult result = runCourse(setupOf(initialParameters(), 5), 5, {.untilReached = true});
  EXPECT_EQ(result.falls, 0);
  EXPECT_EQ(result.reached, result.targets);
  const CourseResult limited = runCourse(setupOf(initialParameters(), 5), 5, {});
  EXPECT_LT(limited.reached, limited.targets) << "the first walk is too slow for the limits";
  EXPECT_LT(limited.time, result.time);
}

TEST(Course, AFallCostsWhatItIsSaidToCostAndTheLastOneEndsIt) {
  const TrialSettings setup = setupOf(clumsyParameters(), 2);
  CourseSettings settings{.mostFalls = 3, .fallCost = 0.0};
  const CourseResult free = runCourse(setup, 2, settings);
  ASSERT_EQ(free.falls, 3);
  settings.fallCost = 20.0;
  const CourseResult paid = runCourse(setup, 2, settings);
  EXPECT_EQ(paid.falls, 3);
  EXPECT_NEAR(paid.reward, free.reward - 3 * 20.0, 1e-9);
  EXPECT_LT(paid.targets, 20) << "the rest of the course is not walked";
}

TEST(Course, PushesMakeTheSameWalkFall) {
  const agent::AgentParameters parameters = initialParameters();
  int falls = 0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const CourseResult quiet = runCourse(setupOf(parameters, seed), seed, {});
    EXPECT_EQ(quiet.falls, 0) << seed;
    // The integral of (tilt / 0.3)^4: nowhere near a fall, it stays below that of a lean of 0.15 rad.
    EXPECT_LT(quiet.unsteadiness, quiet.time / 16.0);
    const CourseResult pushed = runCourse(setupOf(parameters, seed), seed, {.push = 1.5});
    EXPECT_GT(pushed.unsteadiness, 2.0 * quiet.unsteadiness);
    falls += pushed.falls;
  }
  EXPECT_GT(falls, 3);
}

// Of a course that begins with a single target: the noisy one of 4.5 s.
TEST(Course, ATargetIsWorthItsDistanceTimesTheShareOfTheTimeThatItTook) {
  std::uint64_t seed = 1;
  while (makeCourse(seed).front().legs.size() != 1) ASSERT_LT(++seed, 200U);
  const CourseLeg target = makeCourse(seed).front().legs.front();
  const CourseResult result =
      runCourse(setupOf(initialParameters(), seed), seed, {.mostItems = 1, .untilReached = true});
  ASSERT_EQ(result.reached, 1);
  EXPECT_LE(result.distance, target.target.norm());
  EXPECT_GT(result.distance, target.target.norm() - 0.15);
  EXPECT_NEAR(result.reward, result.distance * 4.5 / result.time, 1e-9);
}

// Eight targets, each given up after 30 s.
TEST(Sidestep, WhoStepsOnTheSpotTakesAllTheTime) {
  const double fitness = findTask("sidestep").evaluate(lameParameters(), 7, quickSettings()).fitness;
  EXPECT_LT(fitness, -8 * 30.0) << "light pushes make it lean";
  EXPECT_GT(fitness, -8 * 30.0 - 2.0);
}

// Given up after four falls, it counts as 300 s; and four falls on each of the three courses.
TEST(Sidestep, WhoOnlyFallsPaysForEveryFall) {
  const double fitness = findTask("sidestep").evaluate(clumsyParameters(), 7, quickSettings()).fitness;
  EXPECT_LT(fitness, -300.0 - 12 * 20.0);
  EXPECT_GT(fitness, -300.0 - 12 * 20.0 - 12 * 16.0) << "a second beside itself at the most for each fall";
}

TEST(StandardCourse, WhoIsGivenUpIsWorseThanTheSlowest) {
  const Task& task = findTask("standardCourse");
  const TaskResult result = task.evaluate(clumsyParameters(), 7, quickSettings());
  EXPECT_EQ(measure(result, "falls"), 4.0);
  EXPECT_LT(result.fitness, task.evaluate(initialParameters(), 7, quickSettings()).fitness - 50.0);
}

TEST(Sidestep, WalksTheTargetsWithAHeldHeadingOnly) {
  std::size_t shifts = 0;
  for (const CourseItem& item : makeCourse(7)) {
    for (const CourseLeg& leg : item.legs) shifts += leg.kind == CourseLeg::Kind::Shift ? 1U : 0U;
  }
  const CourseResult result = runCourse(setupOf(initialParameters(), 7), 7,
                                        {.items = CourseSettings::Items::HeldHeading, .untilReached = true});
  EXPECT_EQ(result.targets, static_cast<int>(shifts));
  EXPECT_EQ(result.reached, result.targets);
  EXPECT_EQ(result.stopDrift, 0.0) << "there is no stop among them";
  const TaskResult held = findTask("sidestep").evaluate(initialParameters(), 7, quickSettings());
  const TaskResult whole = findTask("standardCourse").evaluate(initialParameters(), 7, quickSettings());
  EXPECT_LT(measure(held, "time_s"), 0.4 * measure(whole, "time_s"));
}

TEST(Course, ANoisyTargetIsReachedSoonerWhenItIsAveraged) {
  agent::AgentParameters averaging = initialParameters();
  averaging.motion.sets.goToTarget.approach.smoothing = 0.6;
  double without = 0.0;
  double with = 0.0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const CourseSettings byTheClock{.untilReached = true};
    without += runCourse(setupOf(initialParameters(), seed), seed, byTheClock).time;
    with += runCourse(setupOf(averaging, seed), seed, byTheClock).time;
  }
  EXPECT_LT(with / 6.0, without / 6.0 - 1.0) << "s a course, of which one leg of 4.5 s has a noisy target";
}

// It gains nothing, and the four falls after which it is given up cost 5 or 20 each.
TEST(CourseTasks, WhoOnlyFallsPaysForFourFalls) {
  for (const auto& [task, cost] :
       {std::pair("goToTarget", 20.0), std::pair("surefooted", 80.0), std::pair("duel", 80.0)}) {
    const TaskResult result = findTask(task).evaluate(clumsyParameters(), 9, quickSettings());
    EXPECT_NEAR(result.fitness, -cost, 2.0) << task;
    EXPECT_EQ(measure(result, "falls"), 4.0) << task;
  }
}

TEST(CourseTasks, WhoStepsOnTheSpotGainsNothing) {
  for (const char* task : {"goToTarget", "surefooted"})
    EXPECT_NEAR(findTask(task).evaluate(lameParameters(), 9, quickSettings()).fitness, 0.0, 1.0) << task;
}

}  // namespace
}  // namespace nonet::lab
