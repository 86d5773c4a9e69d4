// How long something took, many times: counted by bounds, since a measurement that runs for hours keeps no
// list.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace nonet {

class DurationCounts {
 public:
  /// s. The last is the period of the simulator's cycle (server facts 1.2).
  static constexpr std::array<double, 6> kBounds = {0.001, 0.002, 0.005, 0.010, 0.015, 0.020};

  void add(double seconds) {
    ++count_;
    longest_ = std::max(longest_, seconds);
    for (std::size_t i = 0; i < kBounds.size(); ++i) longer_[i] += seconds > kBounds[i] ? 1 : 0;
  }

  long count() const { return count_; }
  /// s; 0 if there was none.
  double longest() const { return longest_; }
  /// Than kBounds[i].
  long longerThan(std::size_t i) const { return longer_[i]; }

 private:
  long count_ = 0;
  double longest_ = 0.0;
  std::array<long, kBounds.size()> longer_{};
};

}  // namespace nonet
