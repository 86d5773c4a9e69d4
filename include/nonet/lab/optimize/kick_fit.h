// Fits the parameters of a kick along a curve (skills/README.md, curve ... from ball) to what the robot can
// do, by least squares with Ceres: every pose of the foot within the legs' limits, no joint faster than it
// can be, the centre of mass over the stance foot, the ball's way in the direction of the kick's head; and
// among such curves one whose foot meets the ball as fast as it can. Where CMA-ES can begin.
//
// It is kinematics (curve_measures.h): what the stance leg adds in the swing, and the swing's momentum, is
// for the search on the physics.
#pragma once

#include <string>
#include <vector>

#include "nonet/agent/agent.h"
#include "nonet/lab/optimize/curve_measures.h"

namespace nonet::lab {

struct KickFitSettings {
  agent::AgentSettings agent;  // its type, parameters and skill folder
  std::string kick;
  int iterations = 40;  // of the solver, at most, each of up to five times
  int starts = 6;       // of the solver: the kick's own values, and others around them
};

struct FittedParameter {
  std::string name;
  config::Unit unit = config::Unit::None;
  double before = 0.0;
  double after = 0.0;
};

struct KickFit {
  std::string kick;
  int robotType = 0;
  double direction = 0.0;  // of the head, rad
  CurveMeasures before;
  CurveMeasures after;
  bool heldBefore = false;  // all limits
  bool holds = false;
  bool kept = false;                        // nothing to gain: the parameters are as they were
  std::vector<FittedParameter> parameters;  // all of the skill, in its order
};

/// All limits hold, as the fit understands them.
bool withinLimits(const CurveMeasures& measures);

/// Throws std::runtime_error: there is no such kick for this type, it has no curve through the ball, or none
/// of its parameters may move (no ranges).
KickFit fitKick(const KickFitSettings& settings);

/// Before and after, for people.
std::string kickFitTable(const KickFit& fit);
/// The skill's parameters as a file that overlays those in force.
std::string kickFitToml(const KickFit& fit);
std::string skillOverlay(const std::string& skill, const std::vector<FittedParameter>& parameters);

}  // namespace nonet::lab
