// What a kick's curve through the ball asks of the robot, and what it gives the ball, from kinematics alone:
// the torso at rest, the stance foot flat on the ground, as motion::CurveCheck has it.
#pragma once

#include <array>
#include <vector>

#include "nonet/motion/curve_check.h"

namespace nonet::lab {

/// One of the equal steps of a curve.
struct CurveStep {
  bool reached = true;             // the leg meets the pose exactly
  double miss = 0.0;               // m, how far off it is (a turn counts by its lever)
  std::array<double, 6> room{};    // rad from each leg joint to its nearer limit
  std::array<double, 6> speeds{};  // of each leg joint as a share of what it can do
  double height = 0.0;             // m, of the lowest corner of the foot above the ground
  double balance = 0.0;            // m, motion::insideStanceFoot()
};

/// Where the foot meets the ball; if it does not, where it comes nearest.
struct CurveContact {
  double gap = 0.0;        // m between foot and ball; 0: they meet
  double clearance = 0.0;  // m between them where the curve begins; negative: the foot is in the ball
  double deepest = 0.0;    // m between them where the foot is farthest in the ball, of all steps; negative
  double share = 0.0;      // of the curve
  double speed = 0.0;      // m/s of the foot towards the ball, in the time that the curve truly takes
  double direction = 0.0;  // rad, of the ball's way, seen from the stand
};

struct CurveMeasures {
  std::vector<CurveStep> steps;  // motion::FootCurve::kSteps
  bool meetsBall = true;         // motion::PlannedCurve
  CurveContact contact;
  double beside = 0.0;  // fastest joint that moves beside the curve, as a share of what it can do

  double reached() const;     // share of the steps
  double worstMiss() const;   // m
  double leastRoom() const;   // rad
  double worstSpeed() const;  // share: above 1 motion takes longer than the text says
  double leastBalance() const;
  double leastHeight() const;  // m; a foot below the ground is held up by it
};

CurveMeasures measureCurve(const model::RobotModel& model, const motion::PlannedCurve& planned);

}  // namespace nonet::lab
