// Two teams that send anything that is well-formed: joints driven at random and beyond all limits, beams,
// texts, pass requests, a second scene or init; they come and go, and a trainer sets play modes. Whatever
// they do, the simulation goes on with finite numbers and near the field (sim/invariants.h, with wider bounds
// than in a match).
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "nonet/sim/invariants.h"

namespace nonet::lab {

struct RandomEffectorsSettings {
  std::uint64_t seed = 1;
  int players = 4;       // a side, 1..11
  double minutes = 1.0;  // of the server's time
  bool beams = true;     // also what puts robots into each other: beams, second inits, to come and go
  int threads = 1;       // of the physics; the result does not depend on it
};

struct RandomEffectorsResult {
  long cycles = 0;
  long messages = 0;  // sent by agents
  long placed = 0;    // of these: that put their robot elsewhere, or make a new one of it
  long entered = 0;   // robots that were built, after a leave again
  bool stopped = false;
  std::uint64_t signature = 0;  // of the simulation at the end
  std::uint64_t violations = 0;
  std::vector<std::string> messagesOfViolations;  // the first ones
  sim::InvariantExtremes extremes;
};

/// `goOn` is asked in every cycle with what has happened so far; false ends the run.
RandomEffectorsResult playRandomEffectors(
    const RandomEffectorsSettings& settings,
    const std::function<bool(const RandomEffectorsResult&)>& goOn = [](const auto&) { return true; });

}  // namespace nonet::lab
