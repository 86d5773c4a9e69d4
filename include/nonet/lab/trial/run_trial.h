// A run straight ahead as a game asks for it, on the physics alone: out of a stand or any walk, towards a
// far target whose direction is noisy and in every third trial jumps once, among light pushes; in the end a
// stop or another walk.
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

/// The same seed always gives the same run.
RunOutcome runAhead(const TrialSettings& setup, std::uint64_t seed);

}  // namespace nonet::lab
