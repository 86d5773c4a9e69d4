// One seeded fall to the front, the back or the side and the rise from it, on the exact in-process physics
// with the real motion code.
#pragma once

#include <cstddef>
#include <cstdint>

#include "nonet/lab/trial/robot_trial.h"

namespace nonet::lab {

enum class FallKind : std::uint8_t { Front, Back, Side };
inline constexpr std::size_t kFallKindCount = 3;

struct Rise {
  bool fell = false;    // the robot came to lie as wanted
  bool stands = false;  // in the end
  int attempts = 0;
  double collided = 0.0;  // s in which limbs of its own overlapped: the referee would have frozen them
  double time = 0.0;      // from lying (dives: from their end) to a stand that lasts, s
};

/// Front and back: the robot is tipped over while it stands or walks, in a random direction about the wanted
/// one, with random joint angles. Side: the goalie's dive. The same seed always gives the same fall.
Rise fallAndRise(const TrialSettings& setup, FallKind kind, std::uint64_t seed);

}  // namespace nonet::lab
