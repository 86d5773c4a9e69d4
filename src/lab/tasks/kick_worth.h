// What the way of a kicked ball is worth to the tasks that learn kicks.
#pragma once

#include <algorithm>
#include <cmath>

#include "nonet/lab/trial/kick_trial.h"

namespace nonet::lab {

constexpr double kExact = 4.0;       // m, worth of a ball that goes exactly as far as is asked for
constexpr double kPerHeight = 10.0;  // m for each metre that a low kick is too high, or of a chip's height,
constexpr double kHigher = 0.1;      // m, up to so much more than it needs;
constexpr double kShorter = 0.4;     // m: from so far before the farthest landing on it costs

/// Of a ball that went where it should, m: how far it came; of a kick that goes as far as is asked for,
/// `distance`, how exactly; of a chip how high it was; a kick that is to be low pays for height.
inline double worthOfWay(const Kick& kick, const motion::KickHead& head, double distance) {
  if (head.isChip()) {
    const double tooFar = std::max(0.0, kick.landing + kShorter - head.lands);
    return kPerHeight * std::min(kick.height, head.clears + kHigher) - tooFar;
  }
  if (head.scales) return kExact - std::abs(kick.forward - distance);
  const double tooHigh = head.low > 0.0 ? std::max(0.0, kick.highest - head.low) : 0.0;
  return kick.forward - kPerHeight * tooHigh;
}

}  // namespace nonet::lab
