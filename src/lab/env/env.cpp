#include "nonet/lab/env/env.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "nonet/math/random.h"

#include "lab/common/parallel.h"
#include "lab/env/envs.h"

namespace nonet::lab {

std::span<const EnvTask> envTasks() {
  static constexpr std::array kTasks{
      EnvTask{"dribble", "the ball along a straight line; action: speed ahead, speed to the left, turning",
              makeDribbleEnv},
      EnvTask{"receive", "a pass to be stopped; action: speed ahead, speed to the left, turning",
              makeReceiveEnv},
      EnvTask{"run", "ahead as fast as possible; action: a target angle of each joint", makeRunEnv},
  };
  return kTasks;
}

std::unique_ptr<Env> makeEnv(std::string_view task, const EnvSettings& settings) {
  std::string known;
  for (const EnvTask& entry : envTasks()) {
    if (entry.name == task) return entry.make(settings);
    known += fmt::format("{}{}", known.empty() ? "" : ", ", entry.name);
  }
  throw EnvError(fmt::format("unknown environment '{}': use one of {}", task, known));
}

EnvBatch::EnvBatch(std::string_view task, const EnvSettings& settings, int count, int threads,
                   std::uint64_t seed)
    : threads_(threads) {
  if (count < 1) throw EnvError("a batch needs at least one environment");
  for (int i = 0; i < count; ++i) envs_.push_back({makeEnv(task, settings), 0});
  observation_.resize(size() * observations());
  lastObservation_.resize(observation_.size());
  rewards_.resize(size());
  done_.resize(size());
  timeUp_.resize(size());
  reset(seed);
}

void EnvBatch::reset(std::uint64_t seed) {
  seed_ = seed;
  inParallel(static_cast<int>(size()), threads_, [&](int number) {
    const auto i = static_cast<std::size_t>(number);
    envs_[i].episode = 0;
    begin(i);
    std::ranges::copy(of(observation_, i), of(lastObservation_, i).begin());
    rewards_[i] = 0.0F;
    done_[i] = timeUp_[i] = 0;
  });
}

std::span<float> EnvBatch::of(std::vector<float>& observations, std::size_t i) const {
  return std::span(observations).subspan(i * this->observations(), this->observations());
}

// The seed of an episode depends on the environment's number and the episode's only.
void EnvBatch::begin(std::size_t i) {
  Entry& entry = envs_[i];
  entry.env->reset(Random(seed_).fork(i).fork(entry.episode++).next());
  entry.env->observe(of(observation_, i));
}

void EnvBatch::step(std::size_t i, std::span<const float> action) {
  const EnvStep step = envs_[i].env->step(action);
  rewards_[i] = static_cast<float>(step.reward);
  done_[i] = step.done ? 1 : 0;
  timeUp_[i] = step.done && step.timeUp ? 1 : 0;
  envs_[i].env->observe(of(lastObservation_, i));
  if (step.done) {
    begin(i);
  } else {
    std::ranges::copy(of(lastObservation_, i), of(observation_, i).begin());
  }
}

void EnvBatch::step(std::span<const float> actions) {
  const std::size_t width = this->actions();
  if (actions.size() != size() * width)
    throw EnvError(fmt::format("{} actions given, {} needed", actions.size(), size() * width));
  const auto bad = std::ranges::find_if(actions, [](float action) { return std::isnan(action); });
  if (bad != actions.end()) {
    const auto at = static_cast<std::size_t>(bad - actions.begin());
    throw EnvError(fmt::format("action {} of environment {} is not a number", at % width, at / width));
  }
  inParallel(static_cast<int>(size()), threads_, [&](int number) {
    const auto i = static_cast<std::size_t>(number);
    step(i, actions.subspan(i * width, width));
  });
}

}  // namespace nonet::lab
