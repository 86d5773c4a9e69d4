#include "nonet/lab/env/env.h"

#include <array>
#include <stdexcept>

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
  throw std::runtime_error(fmt::format("unknown environment '{}': use one of {}", task, known));
}

EnvBatch::EnvBatch(std::string_view task, const EnvSettings& settings, int count, int threads,
                   std::uint64_t seed)
    : threads_(threads), seed_(seed) {
  if (count < 1) throw std::runtime_error("a batch needs at least one environment");
  for (int i = 0; i < count; ++i) envs_.push_back({makeEnv(task, settings), 0});
  observation_.resize(size() * observations());
  rewards_.resize(size());
  done_.resize(size());
  inParallel(count, threads_, [&](int i) { begin(static_cast<std::size_t>(i)); });
}

// The seed of an episode depends on the environment's number and the episode's only.
void EnvBatch::begin(std::size_t i) {
  Entry& entry = envs_[i];
  entry.env->reset(Random(seed_).fork(i).fork(entry.episode++).next());
  entry.env->observe(std::span(observation_).subspan(i * observations(), observations()));
}

void EnvBatch::step(std::span<const float> actions) {
  if (actions.size() != size() * this->actions())
    throw std::runtime_error(
        fmt::format("{} actions given, {} needed", actions.size(), size() * this->actions()));
  inParallel(static_cast<int>(size()), threads_, [&](int number) {
    const auto i = static_cast<std::size_t>(number);
    Entry& entry = envs_[i];
    const EnvStep step = entry.env->step(actions.subspan(i * this->actions(), this->actions()));
    rewards_[i] = static_cast<float>(step.reward);
    done_[i] = step.done ? 1 : 0;
    if (step.done) {
      begin(i);
    } else {
      entry.env->observe(std::span(observation_).subspan(i * observations(), observations()));
    }
  });
}

}  // namespace nonet::lab
