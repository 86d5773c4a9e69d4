// How many cycles lie between two messages, by the server's printed time.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "nonet/math/types.h"

namespace nonet::protocol {

/// What a cycle adds to the server's time (s), which is a 32-bit sum of steps: about 0.02 at first, 0.0234
/// from 65,536 s on, 0.0156 from 131,072 s, 0.0313 from 262,144 s, and 0 from 524,288 s, where it stands
/// still.
inline double serverStep(double time) {
  const auto before = static_cast<float>(time);
  const float after = before + static_cast<float>(kCycleTime);
  return static_cast<double>(after) - static_cast<double>(before);
}

/// Whether the printed time (s) tells the sum itself, since the next 32-bit number is further than the next
/// two decimals: from 131,072 s on, until it stands still.
inline bool tellsSum(double time) {
  constexpr double kPrinted = 0.01;  // s
  const auto sum = static_cast<float>(time);
  const float next = std::nextafter(sum, std::numeric_limits<float>::infinity());
  return serverStep(time) > 0.0 && static_cast<double>(next) - static_cast<double>(sum) > kPrinted;
}

/// The server's time is printed with two decimals (server facts 1.5): a step of 0.02 s looks like 0.01 to
/// 0.03 s, two like 0.03 to 0.05. A smoothed time tells them apart. The printed one may be 0.005 s beside the
/// true one for hundreds of cycles, so that the smoothed one follows it, and then change sides at once. Where
/// the printed time tells the sum there is nothing to smooth.
class ServerClock {
 public:
  /// From the message before to the one of this time (s): 1 for the first, 0 for one that is not newer.
  int cyclesUntil(double time) {
    const double step = stepTo(time);
    if (!runs_) {
      runs_ = true;
      last_ = time_ = time;
      return 1;
    }
    if (!(time > last_ + 0.25 * kCycleTime)) return 0;
    last_ = time;
    const bool exact = tellsSum(time);
    const double now = exact ? static_cast<double>(static_cast<float>(time)) : time;
    const double swing = exact && tellsSum(time_) ? 0.0 : kSwing;
    const double ahead = std::min(now - time_, kLongest);
    const int cycles = std::max(1, static_cast<int>(std::lround((ahead - swing) / step)));
    time_ += cycles * step;
    time_ += (exact ? 1.0 : kSmoothing) * std::clamp(now - time_, -0.5 * kCycleTime, 0.5 * kCycleTime);
    return cycles;
  }

 private:
  // Where the step changes the longer one, so that a single message is no double one. Who counts on where the
  // server's time stands still does so by whole cycles.
  double stepTo(double time) const {
    const double step = std::max(serverStep(time), runs_ ? serverStep(last_) : 0.0);
    return step > 0.0 ? step : kCycleTime;
  }

  static constexpr double kSwing = 0.0025;  // s, so that one step of 0.03 s stays one
  static constexpr double kSmoothing = 0.1;
  static constexpr double kLongest = 1e6;  // s

  bool runs_ = false;
  double last_ = 0.0;  // as printed, s
  double time_ = 0.0;  // estimate of the server's time behind the two decimals, s
};

}  // namespace nonet::protocol
