// The trials as environments for people who learn by reinforcement: observation, action, reward, on the exact
// server. One step is one decision of the learner; episodes begin and end by themselves.
//
// A batch gives the same numbers for the same seed and actions, however many threads it runs on.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "nonet/agent/agent.h"
#include "nonet/sim/settings/settings.h"

namespace nonet::lab {

struct EnvSettings {
  agent::AgentSettings agent;
  sim::Settings server;
};

/// A task that nobody knows, or actions that no environment can take.
class EnvError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct EnvStep {
  double reward = 0.0;
  bool done = false;    // the episode is over: reset before the next step
  bool timeUp = false;  // and only because its time was up: more could have been earned
};

/// One episode after the other of one task.
class Env {
 public:
  virtual ~Env() = default;
  virtual std::size_t observations() const = 0;
  virtual std::size_t actions() const = 0;
  virtual double secondsPerStep() const = 0;

  virtual void reset(std::uint64_t seed) = 0;
  /// Entries of the action beyond -1 .. 1 count as those.
  virtual EnvStep step(std::span<const float> action) = 0;
  virtual void observe(std::span<float> observation) const = 0;
};

struct EnvTask {
  std::string_view name;
  std::string_view description;
  std::unique_ptr<Env> (*make)(const EnvSettings& settings);
};
std::span<const EnvTask> envTasks();
/// Throws EnvError that lists the known names.
std::unique_ptr<Env> makeEnv(std::string_view task, const EnvSettings& settings);

/// Several environments that step together. An episode that has ended is followed by the next one at once:
/// its last reward comes with the first observation of the next.
class EnvBatch {
 public:
  /// Begins as reset(seed) does. `threads` 0: as many as there are processors, never more than environments.
  EnvBatch(std::string_view task, const EnvSettings& settings, int count, int threads, std::uint64_t seed);

  /// All environments begin their first episodes of this seed: what follows depends on it and the actions
  /// only.
  void reset(std::uint64_t seed);

  std::size_t size() const { return envs_.size(); }
  std::size_t observations() const { return envs_.front().env->observations(); }
  std::size_t actions() const { return envs_.front().env->actions(); }
  double secondsPerStep() const { return envs_.front().env->secondsPerStep(); }

  /// size() x actions() numbers, environment by environment. Throws EnvError before anything has moved if
  /// their count is another, or one of them is not a number.
  void step(std::span<const float> actions);

  /// size() x observations() numbers, environment by environment.
  std::span<const float> observation() const { return observation_; }
  std::span<const float> rewards() const { return rewards_; }
  /// 1 for an episode that the last step has ended.
  std::span<const std::uint8_t> done() const { return done_; }
  /// 1 for one of these that has ended only because its time was up.
  std::span<const std::uint8_t> timeUp() const { return timeUp_; }
  /// As observation(), but where the last step has ended an episode it is the episode's last one.
  std::span<const float> lastObservation() const { return lastObservation_; }

 private:
  struct Entry {
    std::unique_ptr<Env> env;
    std::uint64_t episode = 0;
  };
  void begin(std::size_t i);
  void step(std::size_t i, std::span<const float> action);
  std::span<float> of(std::vector<float>& observations, std::size_t i) const;

  std::vector<Entry> envs_;
  int threads_ = 0;
  std::uint64_t seed_ = 1;
  std::vector<float> observation_;
  std::vector<float> rewards_;
  std::vector<std::uint8_t> done_;
  std::vector<std::uint8_t> timeUp_;
  std::vector<float> lastObservation_;
};

}  // namespace nonet::lab
