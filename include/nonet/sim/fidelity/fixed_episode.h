// A fixed episode of the physics and the sensors: robots of all types and a ball, all handled roughly. Its
// signature tells whether a change has an effect; its duration tells what a cycle costs.
#pragma once

#include <cstdint>

#include "nonet/sim/physics/world.h"

namespace nonet::sim {

struct EpisodeResult {
  std::uint64_t signature = 0;  // of the last state and of all that was sensed
  double worldSeconds = 0.0;    // processor time of the physics, all threads
  double senseSeconds = 0.0;    // processor time of sensing
  double simulated = 0.0;       // s
};

/// The robots stand apart and step on the spot with random motions of arms and head; with `rough` they start
/// within each other's reach.
EpisodeResult runFixedEpisode(const WorldSettings& settings, int robots, int cycles, bool rough);

}  // namespace nonet::sim
