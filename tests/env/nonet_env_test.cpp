// The C interface gives the numbers of the batch that it holds, and refuses what is wrong with a code and a
// text.
#include "nonet/env/nonet_env.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "nonet/agent/agent_setup.h"
#include "nonet/lab/env/env.h"

#include "env/c_client.h"

namespace {

using testing::HasSubstr;

nonet_env_options options(const char* task, int envs, std::uint64_t seed) {
  nonet_env_options options;
  EXPECT_EQ(nonet_env_default_options(&options), NONET_ENV_OK);
  options.task = task;
  options.envs = envs;
  options.seed = seed;
  options.quick = 1;
  return options;
}

/// A batch with the arrays of its caller.
struct Batch {
  explicit Batch(const nonet_env_options& options) {
    EXPECT_EQ(nonet_env_create(&options, &env), NONET_ENV_OK) << nonet_env_last_error();
    EXPECT_EQ(nonet_env_get_sizes(env, &sizes), NONET_ENV_OK);
    observations.resize(sizes.envs * sizes.observations);
    last.resize(observations.size());
    actions.resize(sizes.envs * sizes.actions);
    rewards.resize(sizes.envs);
    terminated.resize(sizes.envs);
    truncated.resize(sizes.envs);
  }
  ~Batch() { nonet_env_destroy(env); }
  Batch(const Batch&) = delete;
  Batch& operator=(const Batch&) = delete;

  nonet_env_code reset(std::uint64_t seed) {
    return nonet_env_reset(env, seed, observations.data(), observations.size());
  }
  nonet_env_code step() {
    return nonet_env_step(env, actions.data(), actions.size(), observations.data(), observations.size(),
                          rewards.data(), terminated.data(), truncated.data(), sizes.envs);
  }
  nonet_env_code final() { return nonet_env_final_observations(env, last.data(), last.size()); }

  nonet_env* env = nullptr;
  nonet_env_sizes sizes{};
  std::vector<float> observations;
  std::vector<float> last;
  std::vector<float> actions;
  std::vector<float> rewards;
  std::vector<std::uint8_t> terminated;
  std::vector<std::uint8_t> truncated;
};

/// Actions of the step `i`: no two of them the same, beyond 1 now and then.
void act(std::vector<float>& actions, int i) {
  for (std::size_t k = 0; k < actions.size(); ++k)
    actions[k] = 1.2F * std::sin(0.37F * static_cast<float>(i) + 1.7F * static_cast<float>(k));
}

/// All that `steps` steps after a reset to `seed` show.
std::vector<float> history(Batch& batch, std::uint64_t seed, int steps) {
  EXPECT_EQ(batch.reset(seed), NONET_ENV_OK);
  std::vector<float> all = batch.observations;
  for (int i = 0; i < steps; ++i) {
    act(batch.actions, i);
    EXPECT_EQ(batch.step(), NONET_ENV_OK) << nonet_env_last_error();
    for (const auto* values : {&batch.observations, &batch.rewards})
      all.insert(all.end(), values->begin(), values->end());
    for (const auto* flags : {&batch.terminated, &batch.truncated})
      all.insert(all.end(), flags->begin(), flags->end());
  }
  return all;
}

nonet::lab::EnvBatch reference(const char* task, int envs, std::uint64_t seed) {
  nonet::lab::EnvSettings settings;
  nonet::agent::AgentChoice choice;
  choice.seed = seed;
  settings.agent = nonet::agent::makeAgentSettings(choice, NONET_SOURCE_DIR);
  settings.server.quickSolver = true;
  return {task, settings, envs, 1, seed};
}

TEST(NonetEnv, GivesTheNumbersOfTheBatch) {
  for (const char* task : {"run", "dribble", "receive"}) {
    nonet_env_options wanted = options(task, 2, 7);
    wanted.threads = 2;
    Batch batch(wanted);
    nonet::lab::EnvBatch expected = reference(task, 2, 7);
    ASSERT_EQ(batch.sizes.envs, expected.size());
    ASSERT_EQ(batch.sizes.observations, expected.observations());
    ASSERT_EQ(batch.sizes.actions, expected.actions());
    ASSERT_EQ(batch.sizes.seconds_per_step, expected.secondsPerStep());
    int ends = 0;
    for (int i = 0; i < 100 || (ends == 0 && i < 1000); ++i) {
      act(batch.actions, i);
      expected.step(batch.actions);
      ASSERT_EQ(batch.step(), NONET_ENV_OK);
      ASSERT_EQ(batch.final(), NONET_ENV_OK);
      for (std::size_t k = 0; k < batch.observations.size(); ++k) {
        ASSERT_EQ(batch.observations[k], expected.observation()[k]) << task << i;
        ASSERT_EQ(batch.last[k], expected.lastObservation()[k]) << task << i;
      }
      for (std::size_t k = 0; k < 2; ++k) {
        ASSERT_EQ(batch.rewards[k], expected.rewards()[k]) << task << i;
        ASSERT_EQ(batch.terminated[k] + batch.truncated[k], expected.done()[k]) << task << i;
        ends += expected.done()[k];
      }
    }
    EXPECT_GT(ends, 0) << task << ": nothing was seen of the next episode";
  }
}

TEST(NonetEnv, AResetBeginsAnewWhateverWasBefore) {
  Batch batch(options("receive", 2, 3));
  const std::vector<float> first = history(batch, 9, 80);  // 4.8 s: passes end, others begin
  EXPECT_NE(history(batch, 10, 80), first);
  EXPECT_EQ(history(batch, 9, 80), first);
  Batch other(options("receive", 2, 9));
  EXPECT_EQ(history(other, 9, 80), first);
}

// A robot that stands for ten seconds has not failed: its time is up, and it stands there still.
TEST(NonetEnv, TellsAnEndByTimeFromAFall) {
  Batch batch(options("run", 1, 1));
  ASSERT_EQ(batch.reset(1), NONET_ENV_OK);
  int steps = 0;
  do {
    ASSERT_EQ(batch.step(), NONET_ENV_OK);
    ASSERT_EQ(batch.final(), NONET_ENV_OK);
    ASSERT_EQ(batch.terminated[0], 0);
    if (batch.truncated[0] == 0) {
      ASSERT_EQ(batch.last, batch.observations);
    }
  } while (batch.truncated[0] == 0 && ++steps < 600);
  EXPECT_NEAR(steps * batch.sizes.seconds_per_step, 10.0, 0.1);
  EXPECT_NE(batch.last, batch.observations);
  std::fill(batch.actions.begin(), batch.actions.end(), 1.0F);
  steps = 0;
  do {
    ASSERT_EQ(batch.step(), NONET_ENV_OK);
  } while (batch.terminated[0] == 0 && ++steps < 150);
  EXPECT_EQ(batch.terminated[0], 1);
  EXPECT_EQ(batch.truncated[0], 0);
  EXPECT_LT(batch.rewards[0], -0.5F);
}

// Two batches in two threads do not see each other; each thread has its own errors.
TEST(NonetEnv, BatchesWorkAtOnce) {
  Batch one(options("dribble", 1, 1));
  Batch two(options("run", 2, 2));
  const std::vector<float> oneAlone = history(one, 5, 60);
  const std::vector<float> twoAlone = history(two, 6, 120);
  std::vector<float> oneBeside;
  std::string otherError;
  EXPECT_EQ(nonet_env_reset(nullptr, 1, nullptr, 0), NONET_ENV_BAD_ARGUMENT);
  const std::string error = nonet_env_last_error();
  std::thread thread([&] {
    oneBeside = history(one, 5, 60);
    nonet_env_get_sizes(one.env, nullptr);
    otherError = nonet_env_last_error();
  });
  EXPECT_EQ(history(two, 6, 120), twoAlone);
  thread.join();
  EXPECT_EQ(oneBeside, oneAlone);
  EXPECT_EQ(nonet_env_last_error(), error);
  EXPECT_THAT(otherError, HasSubstr("sizes is a null pointer"));
}

TEST(NonetEnv, NamesItsTasks) {
  EXPECT_EQ(nonet_env_version(), NONET_ENV_VERSION);
  std::size_t count = 0;
  for (; nonet_env_task_name(count) != nullptr; ++count) {
    EXPECT_EQ(nonet_env_task_name(count), nonet::lab::envTasks()[count].name);
    EXPECT_EQ(nonet_env_task_description(count), nonet::lab::envTasks()[count].description);
  }
  EXPECT_EQ(count, nonet::lab::envTasks().size());
  EXPECT_EQ(nonet_env_task_description(count), nullptr);
  EXPECT_EQ(nonet_env_task_name(std::numeric_limits<std::size_t>::max()), nullptr);
}

/// Code and text of a batch that cannot be made.
std::pair<nonet_env_code, std::string> refusal(const nonet_env_options& options) {
  char other = 0;
  auto* env = reinterpret_cast<nonet_env*>(&other);  // something that must not stay
  const nonet_env_code code = nonet_env_create(&options, &env);
  EXPECT_EQ(env, nullptr);
  nonet_env_destroy(env);
  return {code, nonet_env_last_error()};
}

TEST(NonetEnv, RefusesWrongOptions) {
  const nonet_env_options good = options("run", 1, 1);
  struct Case {
    void (*spoil)(nonet_env_options&);
    nonet_env_code code;
    const char* text;
  };
  static const std::array<const char*, 1> kUnknown = {"no.such=1"};
  static const std::array<const char*, 1> kNothing = {nullptr};
  static const std::array<const char*, 1> kNoValue = {"motion.walk.gait.maxStepX"};
  static const auto set = [](nonet_env_options& o, const auto& texts) {
    o.parameters = texts.data();
    o.parameter_count = texts.size();
  };
  for (const Case& wrong : std::initializer_list<Case>{
           {[](auto& o) { o.task = nullptr; }, NONET_ENV_BAD_ARGUMENT, "options.task is a null pointer"},
           {[](auto& o) { o.task = "fly"; }, NONET_ENV_BAD_ARGUMENT,
            "unknown environment 'fly': use one of dribble"},
           {[](auto& o) { o.struct_size = 8; }, NONET_ENV_BAD_ARGUMENT, "struct_size is 8"},
           {[](auto& o) { o.envs = 0; }, NONET_ENV_BAD_ARGUMENT, "envs is 0, not 1 to 10000"},
           {[](auto& o) { o.envs = 10001; }, NONET_ENV_BAD_ARGUMENT, "envs is 10001"},
           {[](auto& o) { o.threads = -1; }, NONET_ENV_BAD_ARGUMENT, "threads is -1"},
           {[](auto& o) { o.robot_type = 5; }, NONET_ENV_BAD_ARGUMENT, "robot_type is 5"},
           {[](auto& o) { o.parameter_count = 1; }, NONET_ENV_BAD_ARGUMENT, "parameters is a null"},
           {[](auto& o) { set(o, kNothing); }, NONET_ENV_BAD_ARGUMENT, "parameters[0] is a null"},
           {[](auto& o) { set(o, kUnknown); }, NONET_ENV_BAD_ARGUMENT, "no.such"},
           {[](auto& o) { set(o, kNoValue); }, NONET_ENV_BAD_ARGUMENT, "motion.walk.gait.maxStepX"},
           {[](auto& o) { o.data_folder = "/no/folder"; }, NONET_ENV_NO_DATA,
            "data_folder /no/folder: there"},
       }) {
    nonet_env_options spoilt = good;
    wrong.spoil(spoilt);
    const auto [code, text] = refusal(spoilt);
    EXPECT_EQ(code, wrong.code) << wrong.text;
    EXPECT_THAT(text, HasSubstr(wrong.text));
  }
  nonet_env* env = nullptr;
  EXPECT_EQ(nonet_env_create(nullptr, &env), NONET_ENV_BAD_ARGUMENT);
  EXPECT_EQ(nonet_env_create(&good, nullptr), NONET_ENV_BAD_ARGUMENT);
  EXPECT_EQ(nonet_env_default_options(nullptr), NONET_ENV_BAD_ARGUMENT);
}

TEST(NonetEnv, RefusesAFolderWithoutItsContents) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(testing::TempDir()) / ("nonet_env_empty_" + std::to_string(::getpid()));
  fs::create_directories(folder / "params");
  fs::create_directories(folder / "skills");
  nonet_env_options wanted = options("run", 1, 1);
  const std::string name = folder.string();
  wanted.data_folder = name.c_str();
  const auto [code, text] = refusal(wanted);
  fs::remove_all(folder);
  EXPECT_EQ(code, NONET_ENV_NO_DATA);
  EXPECT_THAT(text, HasSubstr("there are no skills"));
}

TEST(NonetEnv, EveryOptionCounts) {
  nonet_env_options wanted = options("dribble", 1, 1);
  Batch plain(wanted);
  const std::vector<float> before = history(plain, 1, 20);
  const std::array<const char*, 2> slow = {"motion.positioning.gait.maxStepX=0.01",
                                           "motion.walk.gait.maxStepX=1cm"};
  wanted.parameters = slow.data();
  wanted.parameter_count = slow.size();
  EXPECT_NE(history(*std::make_unique<Batch>(wanted), 1, 20), before);
  wanted.parameter_count = 0;
  EXPECT_EQ(history(*std::make_unique<Batch>(wanted), 1, 20), before);
  wanted.robot_type = 2;
  EXPECT_NE(history(*std::make_unique<Batch>(wanted), 1, 20), before);
  wanted.robot_type = 0;
  wanted.data_folder = NONET_SOURCE_DIR;
  EXPECT_EQ(history(*std::make_unique<Batch>(wanted), 1, 20), before);
}

// The quick stepper differs by rounding, which shows after some steps.
TEST(NonetEnv, TheStepperCounts) {
  nonet_env_options wanted = options("dribble", 1, 1);
  const std::vector<float> quick = history(*std::make_unique<Batch>(wanted), 1, 100);
  wanted.quick = 0;
  EXPECT_NE(history(*std::make_unique<Batch>(wanted), 1, 100), quick);
}

// A call that is refused has moved nothing: afterwards all goes on as if it had not been.
TEST(NonetEnv, RefusedCallsChangeNothing) {
  Batch batch(options("run", 2, 1));
  Batch twin(options("run", 2, 1));
  const auto both = [&](int i) {
    act(batch.actions, i);
    act(twin.actions, i);
    ASSERT_EQ(batch.step(), NONET_ENV_OK);
    ASSERT_EQ(twin.step(), NONET_ENV_OK);
    ASSERT_EQ(batch.observations, twin.observations);
    ASSERT_EQ(batch.rewards, twin.rewards);
  };
  both(0);
  float* const actions = batch.actions.data();
  float* const seen = batch.observations.data();
  float* const rewards = batch.rewards.data();
  std::uint8_t* const ends = batch.terminated.data();
  const std::size_t taken = batch.actions.size();
  const std::size_t shown = batch.observations.size();
  nonet_env* const env = batch.env;
  const auto refused = [](nonet_env_code code, const char* text) {
    EXPECT_EQ(code, NONET_ENV_BAD_ARGUMENT) << text;
    EXPECT_THAT(nonet_env_last_error(), HasSubstr(text));
  };
  refused(nonet_env_step(nullptr, actions, taken, seen, shown, rewards, ends, ends, 2), "env is a null");
  refused(nonet_env_step(env, nullptr, taken, seen, shown, rewards, ends, ends, 2), "actions is a null");
  refused(nonet_env_step(env, actions, taken - 1, seen, shown, rewards, ends, ends, 2),
          "actions holds 43 numbers, not the 44 needed");
  refused(nonet_env_step(env, actions, taken, nullptr, shown, rewards, ends, ends, 2), "observations is a");
  refused(nonet_env_step(env, actions, taken, seen, shown + 1, rewards, ends, ends, 2), "observations holds");
  refused(nonet_env_step(env, actions, taken, seen, shown, nullptr, ends, ends, 2), "rewards is a null");
  refused(nonet_env_step(env, actions, taken, seen, shown, rewards, nullptr, ends, 2),
          "terminated is a null");
  refused(nonet_env_step(env, actions, taken, seen, shown, rewards, ends, nullptr, 2), "truncated is a null");
  refused(nonet_env_step(env, actions, taken, seen, shown, rewards, ends, ends, 3),
          "rewards holds 3 numbers");
  batch.actions[25] = std::numeric_limits<float>::quiet_NaN();
  refused(batch.step(), "action 3 of environment 1 is not a number");
  refused(nonet_env_reset(env, 1, nullptr, shown), "observations is a null");
  refused(nonet_env_reset(env, 1, seen, 1), "observations holds 1 numbers");
  refused(nonet_env_final_observations(env, seen, 0), "observations holds 0 numbers");
  refused(nonet_env_final_observations(nullptr, seen, shown), "env is a null");
  refused(nonet_env_get_sizes(nullptr, nullptr), "env is a null");
  both(1);
  nonet_env_destroy(nullptr);
}

TEST(NonetEnv, EndlessActionsCountAsTheLargest) {
  Batch endless(options("run", 1, 1));
  Batch largest(options("run", 1, 1));
  std::fill(endless.actions.begin(), endless.actions.end(), std::numeric_limits<float>::infinity());
  std::fill(largest.actions.begin(), largest.actions.end(), 1.0F);
  for (int i = 0; i < 20; ++i) {
    ASSERT_EQ(endless.step(), NONET_ENV_OK);
    ASSERT_EQ(largest.step(), NONET_ENV_OK);
    ASSERT_EQ(endless.observations, largest.observations);
  }
}

TEST(NonetEnv, ServesAProgramInC) {
  double sum = 1.0;
  std::array<char, 300> error{};
  EXPECT_EQ(cClient("run", 50, &sum, error.data(), error.size()), NONET_ENV_OK) << error.data();
  EXPECT_NEAR(sum, 0.0, 0.1);  // two robots that stand
  EXPECT_EQ(cClient("fly", 50, &sum, error.data(), error.size()), NONET_ENV_BAD_ARGUMENT);
  EXPECT_THAT(error.data(), HasSubstr("unknown environment 'fly'"));
}

}  // namespace
