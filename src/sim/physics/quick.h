// The quick stepper: the same equations as ODE's exact stepper, solved by way of the robots' structure
// (StepTree) and a small complementarity problem for the contacts. (ODE's own iterative stepper is of no use
// here: with the robot's light links and strong motors it does not converge in hundreds of iterations.)
#pragma once

#include <memory>
#include <vector>

#include "sim/physics/islands.h"
#include "sim/physics/tree.h"

namespace nonet::sim {

/// What a cell keeps for the quick stepper.
struct QuickCell {
  explicit QuickCell(int robotType) : tree(robotType) {}

  StepTree tree;
  // Of the step in progress:
  std::vector<std::size_t> touched;  // bodies with contacts
  std::vector<Matrix6> responses;    // [i * touched + j]: velocity of touched i by an impulse on touched j
  std::vector<Vector6> impulses;     // of the contacts, per body
};

/// Steps one cluster. Nothing is touched but its cells.
void stepQuickly(Cluster& cluster, dReal seconds);

}  // namespace nonet::sim
