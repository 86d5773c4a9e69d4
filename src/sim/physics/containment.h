// Keeps the solver's answer to impossible positions from becoming infinite. Robots that are beamed or pushed
// into each other may leave ODE without a solution; it then gives speeds of hundreds of metres per second,
// which grow from step to step until a quaternion is no number, and ODE ends the process.
//
// In a match nothing comes near these bounds (sim/invariants.h), so nothing changes there, to the last bit.
#pragma once

#include "sim/physics/islands.h"

namespace nonet::sim {

/// Before a step: where all bodies of the island are.
void rememberPoses(Island& island);

/// After it: a robot with a body that is faster than anything can be stands still, and one with numbers that
/// are none stands still where it was before the step.
void contain(Island& island);

}  // namespace nonet::sim
