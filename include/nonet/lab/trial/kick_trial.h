// One seeded kick from the stand or out of the last steps to the ball, the ball some centimetres beside its
// nominal place, on the exact in-process physics with the real motion code.
#pragma once

#include <cstdint>

#include "nonet/lab/trial/robot_trial.h"

namespace nonet::lab {

struct Kick {
  double forward = 0.0;    // m that the ball went in the wanted direction, until it rolled out
  double aside = 0.0;      // m to the left of it
  double duration = 0.0;   // s from the request to the end of the skill
  double ballSpeed = 0.0;  // m/s, the fastest
  bool fell = false;

  bool missed() const;
  double direction() const;  // rad, positive to the left
};

enum class KickFrom : std::uint8_t { Stand, Walk };

/// The same seed always gives the same kick. The motion stage is told the place of the ball with an error
/// such as the world model's.
Kick kickOnce(const TrialSetup& setup, model::Side side, KickFrom from, std::uint64_t seed);

}  // namespace nonet::lab
