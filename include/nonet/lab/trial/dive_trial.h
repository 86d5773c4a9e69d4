// One goalie's dive and the rise from it, on the exact in-process physics with the real motion code.
#pragma once

#include <array>
#include <cstdint>

#include "nonet/lab/trial/robot_trial.h"

namespace nonet::lab {

struct Dive {
  static constexpr std::array<double, 7> kTimes{0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0};  // s after the request
  /// At those times: how far to its side, from where it stood, the robot bars the way to a ball on the
  /// ground, m.
  std::array<double, kTimes.size()> reach{};
  double riseTime = 0.0;  // s from the end of the dive to a stand that lasts
  int attempts = 0;       // to rise
  bool stands = false;    // in the end
};

/// The same seed always gives the same dive.
Dive diveAndRise(const TrialSetup& setup, model::Side side, std::uint64_t seed);

}  // namespace nonet::lab
