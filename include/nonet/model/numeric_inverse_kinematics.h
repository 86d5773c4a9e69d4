// Inverse kinematics by bounded least squares on Ceres: a second algorithm that checks the closed forms, and
// a careful one for targets that the joint limits forbid (skills are prepared with it, off the cycle: it
// allocates and takes some hundred microseconds).
#pragma once

#include "nonet/model/inverse_kinematics.h"

namespace nonet::model {

struct NumericSolution {
  double positionError = 0.0;     // m, of the pose reached
  double orientationError = 0.0;  // rad, angle between the orientations; 0 for arms
  /// Square root of position error^2 + (kOrientationLever * 2 sin(orientation error / 2))^2, m: what the
  /// solver makes least.
  double distance = 0.0;
  bool converged = false;
};

/// From `angles` (clamped into the limits first) to the nearest minimum within the joint limits.
NumericSolution numericLegInverseKinematics(const RobotModel& model, Side side, const Pose3& X_RS,
                                            LegAngles& angles);

/// The centre of the lower arm as near to p_RH as the limits allow, from `angles`.
NumericSolution numericArmInverseKinematics(const RobotModel& model, Side side, const Vector3& p_RH,
                                            ArmAngles& angles);

}  // namespace nonet::model
