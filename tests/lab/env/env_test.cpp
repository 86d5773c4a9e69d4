// The environments: the same seed and actions give the same numbers on any number of threads, and what is
// rewarded is what happens.
#include "nonet/lab/env/env.h"

#include <cmath>

#include <gtest/gtest.h>

#include "nonet/agent/agent_setup.h"

namespace nonet::lab {
namespace {

EnvSettings settings() {
  EnvSettings settings;
  settings.agent = agent::makeAgentSettings({}, NONET_SOURCE_DIR);
  settings.server.quickSolver = true;
  return settings;
}

TEST(Env, TheBatchDoesNotDependOnThreads) {
  EnvBatch one("receive", settings(), 3, 1, 7);
  EnvBatch three("receive", settings(), 3, 3, 7);
  std::vector<float> actions(3 * one.actions());
  bool ended = false;
  for (int i = 0; i < 80; ++i) {
    for (std::size_t k = 0; k < actions.size(); ++k)
      actions[k] = 0.2F * std::sin(static_cast<float>(i + 5 * k));
    one.step(actions);
    three.step(actions);
    for (std::size_t k = 0; k < one.observation().size(); ++k)
      ASSERT_EQ(one.observation()[k], three.observation()[k]) << i;
    for (std::size_t k = 0; k < one.size(); ++k) {
      ASSERT_EQ(one.rewards()[k], three.rewards()[k]);
      ASSERT_EQ(one.done()[k], three.done()[k]);
      ended = ended || one.done()[k] != 0;
    }
  }
  EXPECT_TRUE(ended);  // 4.8 s: the next passes have begun
}

// Straight ahead the robot runs into the ball half a metre before it, and the ball goes on along the line.
TEST(Env, DribblingForwardEarnsMetres) {
  const std::unique_ptr<Env> env = makeEnv("dribble", settings());
  env->reset(3);
  std::vector<float> seen(env->observations());
  env->observe(seen);
  EXPECT_NEAR(seen[0], 0.5F, 0.1F);  // the ball ahead
  EXPECT_NEAR(seen[1], 0.0F, 0.1F);
  double earned = 0.0;
  const std::vector<float> ahead{0.6F, 0.0F, 0.0F};
  for (int i = 0; i < 50; ++i) {
    const EnvStep step = env->step(ahead);
    earned += step.reward;
    if (step.done) break;
  }
  EXPECT_GT(earned, 0.5);
}

// Who only stands holds few passes; nothing has ended when the others' time is up.
TEST(Env, APassThatIsNotHeldEndsByTime) {
  const std::unique_ptr<Env> env = makeEnv("receive", settings());
  const std::vector<float> still(env->actions(), 0.0F);
  int byTime = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    env->reset(seed);
    EnvStep step;
    double time = 0.0;
    while (!step.done && time < 10.0) {
      step = env->step(still);
      time += env->secondsPerStep();
    }
    ASSERT_TRUE(step.done);
    byTime += step.timeUp ? 1 : 0;
    if (step.timeUp) {
      EXPECT_NEAR(time, 4.0, 0.2);
      EXPECT_LE(step.reward, 0.0);
    } else {
      EXPECT_TRUE(step.reward == 1.0 || time < 4.0) << step.reward;
    }
  }
  EXPECT_GT(byTime, 0);
}

TEST(Env, RunningIsStandingWithoutAction) {
  const std::unique_ptr<Env> env = makeEnv("run", settings());
  env->reset(1);
  EXPECT_EQ(env->actions(), 22U);
  std::vector<float> seen(env->observations());
  double earned = 0.0;
  for (int i = 0; i < 50; ++i) {
    const EnvStep step = env->step(std::vector<float>(env->actions(), 0.0F));
    EXPECT_FALSE(step.done);
    earned += step.reward;
  }
  EXPECT_NEAR(earned, 0.0, 0.05);
  // Knees and hips thrown to one side: it falls, which costs and ends the episode.
  bool fell = false;
  for (int i = 0; i < 150 && !fell; ++i) {
    const EnvStep step = env->step(std::vector<float>(env->actions(), 1.0F));
    fell = step.done;
    if (fell) {
      EXPECT_LT(step.reward, -0.5);
    }
  }
  EXPECT_TRUE(fell);
}

TEST(Env, UnknownNamesAndWrongSizesAreNamed) {
  EXPECT_THROW(makeEnv("fly", settings()), EnvError);
  EnvBatch batch("run", settings(), 1, 1, 1);
  EXPECT_THROW(batch.step(std::vector<float>(3)), EnvError);
  EXPECT_THROW(batch.step(std::vector<float>(batch.actions(), std::nanf(""))), EnvError);
}

}  // namespace
}  // namespace nonet::lab
