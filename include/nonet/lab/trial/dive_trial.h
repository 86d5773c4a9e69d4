// One goalie's dive and the rise from it, on the exact in-process physics with the real motion code.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "nonet/lab/trial/robot_trial.h"
#include "nonet/model/ball.h"

namespace nonet::lab {

/// What a robot bars to a ball that comes straight at the plane in which it stood, by the ball's place there
/// and its time after the request.
struct Dive {
  static constexpr int kTimes = 10;   // 0.1 s, 0.2 s, ... 1 s
  static constexpr int kPlaces = 17;  // to the side: 0, 5 cm, ... 80 cm
  static constexpr std::array<double, 3> kHeights{model::kBallRadius, 0.2, 0.4};  // m, of the ball's centre
  static double timeAt(int i) { return 0.1 * (i + 1); }
  static double placeAt(int i) { return 0.05 * i; }

  using Places = std::array<bool, kPlaces>;
  std::array<std::array<Places, kHeights.size()>, kTimes> barred{};
  double riseTime = 0.0;  // s from the end of the dive to a stand that lasts
  int attempts = 0;       // to rise
  bool stands = false;    // in the end
};

/// Plays the skill `name` to this side. The same seed always gives the same dive.
Dive diveAndRise(const TrialSettings& setup, std::string_view name, model::Side side, std::uint64_t seed);

}  // namespace nonet::lab
