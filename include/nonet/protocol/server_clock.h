// How many cycles lie between two messages, by the server's printed time.
#pragma once

#include <algorithm>
#include <cmath>

#include "nonet/math/types.h"

namespace nonet::protocol {

/// The server's time is a 32-bit sum of steps, printed with two decimals (server facts 1.5): a single step
/// looks like 0.01 to 0.03 s, two like 0.03 to 0.05. A smoothed time tells them apart. The printed one may be
/// 0.005 s beside the true one for hundreds of cycles, so that the smoothed one follows it, and then change
/// sides at once.
class ServerClock {
 public:
  /// From the message before to the one of this time (s): 1 for the first, 0 for one that is not newer.
  int cyclesUntil(double time) {
    if (!runs_) {
      runs_ = true;
      last_ = time_ = time;
      return 1;
    }
    if (!(time > last_ + 0.25 * kCycleTime)) return 0;
    last_ = time;
    const double ahead = std::min(time - time_, kLongest);
    const int cycles = std::max(1, static_cast<int>(std::lround((ahead - kSwing) / kCycleTime)));
    time_ += cycles * kCycleTime;
    time_ += kSmoothing * std::clamp(time - time_, -0.5 * kCycleTime, 0.5 * kCycleTime);
    return cycles;
  }

 private:
  static constexpr double kSwing = 0.0025;  // s, so that one step of 0.03 s stays one
  static constexpr double kSmoothing = 0.1;
  static constexpr double kLongest = 1e6;  // s

  bool runs_ = false;
  double last_ = 0.0;  // as printed, s
  double time_ = 0.0;  // estimate of the server's time behind the two decimals, s
};

}  // namespace nonet::protocol
