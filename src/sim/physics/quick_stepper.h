// The quick stepper: the same equations as ODE's exact stepper, solved by way of the robots' structure
// (ArticulatedBodySolver) and a small complementarity problem for the contacts. (ODE's own iterative stepper
// is of no use here: with the robot's light links and strong motors it does not converge in hundreds of
// iterations.)
#pragma once

#include <memory>
#include <vector>

#include "sim/physics/articulated_body_solver.h"
#include "sim/physics/islands.h"

namespace nonet::sim {

/// What a multibody keeps for the quick stepper.
struct QuickState {
  explicit QuickState(int robotType) : solver(robotType) {}

  ArticulatedBodySolver solver;
  // Of the step in progress:
  std::vector<std::size_t> touched;  // bodies with contacts
  std::vector<Matrix6>
      responses;  // [i * touched + j]: velocity of body i by impulses on body j (of `touched`)
  std::vector<Vector6> impulses;  // of the contacts, per body
};

/// Steps one island. Nothing is touched but its members.
void stepQuickly(Island& island, dReal seconds);

}  // namespace nonet::sim
