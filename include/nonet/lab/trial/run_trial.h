// Runs as a game asks for them, on the physics alone: out of a stand or any walk, towards a far target whose
// direction is noisy, among light pushes.
#pragma once

#include <cstdint>

#include "nonet/lab/trial/robot_trial.h"

namespace nonet::lab {

struct RunOutcome {
  double speed = 0.0;         // m/s towards the target, mean over the whole time, from the start on
  double fast = 0.0;          // m/s, the same after the first 1.5 s; 0 if it fell before
  double fellAt = 0.0;        // share of the run's time, if it fell
  double stopTime = 0.0;      // s from the run to a stand, if it had to
  double unsteadiness = 0.0;  // integral of (tilt / 0.5 rad)^4, s
  bool fell = false;          // in the run
  bool fellAfter = false;     // in what followed it
};

/// Straight ahead; in every third trial the target jumps once; in the end a stop or another walk. The same
/// seed always gives the same run.
RunOutcome runAhead(const TrialSettings& setup, std::uint64_t seed);
/// After a far target whose direction leaps by up to 0.8 rad, at times by up to 3 rad, two seconds apart on
/// average, for 8 s, and with the positioning set at times: as the ways around others, new roles and robots
/// nearby make it in a game. Leaps, pushes and noise times `hardness`. Tells `speed` and `fast` (towards
/// where the target is at the time), `fell`, `fellAt` and `unsteadiness`.
RunOutcome runAfter(const TrialSettings& setup, std::uint64_t seed, double hardness = 1.0);

}  // namespace nonet::lab
