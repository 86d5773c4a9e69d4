#include "nonet/env/nonet_env.h"

#include <algorithm>
#include <array>
#include <exception>
#include <filesystem>
#include <memory>
#include <mutex>
#include <new>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include <dlfcn.h>
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "nonet/agent/agent_setup.h"
#include "nonet/agent/data_folder.h"
#include "nonet/config/parameters.h"
#include "nonet/lab/env/env.h"

// What C calls a batch.
struct nonet_env {
  nonet::lab::EnvBatch batch;
};

namespace {

using nonet::lab::EnvBatch;

constexpr int kMostEnvs = 10000;
constexpr int kMostThreads = 1024;

using BadArgument = nonet::lab::EnvError;

/// Of this thread. Memory of its own, so that an error can be told when there is none left.
std::array<char, 2048>& lastError() {
  thread_local std::array<char, 2048> text{};
  return text;
}

nonet_env_code failure(nonet_env_code code, std::string_view text) noexcept {
  std::array<char, 2048>& kept = lastError();
  const std::size_t length = std::min(text.size(), kept.size() - 1);
  std::copy_n(text.begin(), length, kept.begin());
  kept[length] = '\0';
  return code;
}

/// Runs `work`; whatever it throws becomes a code and a text.
template <class Work>
nonet_env_code guarded(const Work& work) noexcept {
  try {
    work();
    return NONET_ENV_OK;
  } catch (const BadArgument& error) {
    return failure(NONET_ENV_BAD_ARGUMENT, error.what());
  } catch (const nonet::agent::DataError& error) {
    return failure(NONET_ENV_NO_DATA, error.what());
  } catch (const nonet::config::ParameterError& error) {
    return failure(NONET_ENV_BAD_ARGUMENT, error.what());
  } catch (const std::bad_alloc&) {
    return failure(NONET_ENV_FAILED, "there is not enough memory");
  } catch (const std::exception& error) {
    return failure(NONET_ENV_FAILED, error.what());
  } catch (...) {
    return failure(NONET_ENV_FAILED, "an unknown error");
  }
}

void needPointer(const void* pointer, std::string_view name) {
  if (pointer == nullptr) throw BadArgument(fmt::format("{} is a null pointer", name));
}

void needRange(int value, int low, int high, std::string_view name) {
  if (value < low || value > high)
    throw BadArgument(fmt::format("{} is {}, not {} to {}", name, value, low, high));
}

/// `count` numbers at `data`, which must be `needed`.
template <class Number>
std::span<Number> array(Number* data, std::size_t count, std::size_t needed, std::string_view name) {
  needPointer(data, name);
  if (count != needed)
    throw BadArgument(fmt::format("{} holds {} numbers, not the {} needed", name, count, needed));
  return {data, count};
}

std::span<float> observationArray(const EnvBatch& batch, float* data, std::size_t count) {
  return array(data, count, batch.size() * batch.observations(), "observations");
}

/// The file of this library: the data of an installation are found from there.
std::string libraryFile() {
  Dl_info info{};
  static const char inside = 0;
  if (::dladdr(&inside, &info) == 0 || info.dli_fname == nullptr) return {};
  std::error_code error;
  const std::filesystem::path file = std::filesystem::canonical(info.dli_fname, error);
  return error ? std::string(info.dli_fname) : file.string();
}

void check(const nonet_env_options& options) {
  if (options.struct_size != sizeof(nonet_env_options))
    throw BadArgument(fmt::format("options.struct_size is {}, not {}: nonet_env_default_options() sets it",
                                  options.struct_size, sizeof(nonet_env_options)));
  needPointer(options.task, "options.task");
  needRange(options.envs, 1, kMostEnvs, "options.envs");
  needRange(options.threads, 0, kMostThreads, "options.threads");
  needRange(options.robot_type, 0, 4, "options.robot_type");
  if (options.parameter_count > 0) needPointer(options.parameters, "options.parameters");
  for (std::size_t i = 0; i < options.parameter_count; ++i)
    needPointer(options.parameters[i], fmt::format("options.parameters[{}]", i));
}

nonet::lab::EnvSettings settingsOf(const nonet_env_options& options) {
  const std::string given = options.data_folder == nullptr ? "" : options.data_folder;
  nonet::agent::AgentChoice choice;
  choice.robotType = options.robot_type;
  choice.seed = options.seed;
  for (std::size_t i = 0; i < options.parameter_count; ++i)
    choice.assignments.emplace_back(options.parameters[i]);
  nonet::lab::EnvSettings settings;
  settings.agent = nonet::agent::makeAgentSettings(
      choice, nonet::agent::dataFolder(given, "data_folder", libraryFile(), NONET_SOURCE_DIR));
  settings.server.quickSolver = options.quick != 0;
  return settings;
}

void keepQuiet() {
  static std::once_flag once;
  std::call_once(once, [] { spdlog::set_level(spdlog::level::warn); });  // who enters the field is no news
}

const nonet::lab::EnvTask* taskAt(std::size_t index) {
  const auto tasks = nonet::lab::envTasks();
  return index < tasks.size() ? &tasks[index] : nullptr;
}

}  // namespace

int nonet_env_version(void) {
  return NONET_ENV_VERSION;
}

const char* nonet_env_last_error(void) {
  return lastError().data();
}

const char* nonet_env_task_name(size_t index) {
  const auto* task = taskAt(index);
  return task == nullptr ? nullptr : task->name.data();  // literals, so they end with a zero
}

const char* nonet_env_task_description(size_t index) {
  const auto* task = taskAt(index);
  return task == nullptr ? nullptr : task->description.data();
}

nonet_env_code nonet_env_default_options(nonet_env_options* options) {
  return guarded([&] {
    needPointer(options, "options");
    *options = {};
    options->struct_size = sizeof(nonet_env_options);
    options->seed = 1;
    options->envs = 1;
  });
}

nonet_env_code nonet_env_create(const nonet_env_options* options, nonet_env** env) {
  return guarded([&] {
    needPointer(env, "env");
    *env = nullptr;
    needPointer(options, "options");
    check(*options);
    keepQuiet();
    *env = std::make_unique<nonet_env>(nonet_env{EnvBatch(options->task, settingsOf(*options), options->envs,
                                                          options->threads, options->seed)})
               .release();
  });
}

void nonet_env_destroy(nonet_env* env) {
  delete env;
}

nonet_env_code nonet_env_get_sizes(const nonet_env* env, nonet_env_sizes* sizes) {
  return guarded([&] {
    needPointer(env, "env");
    needPointer(sizes, "sizes");
    const EnvBatch& batch = env->batch;
    *sizes = {batch.size(), batch.observations(), batch.actions(), batch.secondsPerStep()};
  });
}

nonet_env_code nonet_env_reset(nonet_env* env, uint64_t seed, float* observations, size_t observation_count) {
  return guarded([&] {
    needPointer(env, "env");
    EnvBatch& batch = env->batch;
    const auto shown = observationArray(batch, observations, observation_count);
    batch.reset(seed);
    std::ranges::copy(batch.observation(), shown.begin());
  });
}

nonet_env_code nonet_env_step(nonet_env* env, const float* actions, size_t action_count, float* observations,
                              size_t observation_count, float* rewards, uint8_t* terminated,
                              uint8_t* truncated, size_t env_count) {
  return guarded([&] {
    needPointer(env, "env");
    EnvBatch& batch = env->batch;
    const auto taken = array(actions, action_count, batch.size() * batch.actions(), "actions");
    const auto shown = observationArray(batch, observations, observation_count);
    const auto earned = array(rewards, env_count, batch.size(), "rewards");
    const auto over = array(terminated, env_count, batch.size(), "terminated");
    const auto late = array(truncated, env_count, batch.size(), "truncated");
    batch.step(taken);
    std::ranges::copy(batch.observation(), shown.begin());
    std::ranges::copy(batch.rewards(), earned.begin());
    std::ranges::copy(batch.timeUp(), late.begin());
    std::ranges::transform(batch.done(), batch.timeUp(), over.begin(), [](uint8_t done, uint8_t timeUp) {
      return static_cast<uint8_t>(done != 0 && timeUp == 0 ? 1 : 0);
    });
  });
}

nonet_env_code nonet_env_final_observations(const nonet_env* env, float* observations,
                                            size_t observation_count) {
  return guarded([&] {
    needPointer(env, "env");
    const EnvBatch& batch = env->batch;
    std::ranges::copy(batch.lastObservation(),
                      observationArray(batch, observations, observation_count).begin());
  });
}
