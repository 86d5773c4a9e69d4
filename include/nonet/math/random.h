// Seeded random numbers that are the same on every machine and compiler (the distributions of <random> are
// not). Generator: xoshiro256++ [Blackman 2021], seeded through splitmix64; both are in the public domain.
#pragma once

#include <array>
#include <cstdint>

namespace nonet {

class Random {
 public:
  using State = std::array<std::uint64_t, 6>;  // four words of xoshiro, then the pending normal (flag, bits)

  explicit Random(std::uint64_t seed = 1);

  std::uint64_t next();
  /// Uniform in [0, 1).
  double uniform();
  /// Uniform in [low, high).
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Uniform integer in [0, count); count > 0.
  std::uint64_t below(std::uint64_t count);
  /// Standard normal (polar method [Marsaglia 1964]; the second value of each pair is kept).
  double normal();
  double normal(double mean, double sigma) { return mean + sigma * normal(); }
  /// An independent generator for a named sub-task: the same (seed, stream) always gives the same numbers.
  Random fork(std::uint64_t stream) const;

  State state() const;
  void setState(const State& state);

 private:
  std::array<std::uint64_t, 4> words_{};
  double pendingNormal_ = 0.0;
  bool hasPendingNormal_ = false;
};

}  // namespace nonet
