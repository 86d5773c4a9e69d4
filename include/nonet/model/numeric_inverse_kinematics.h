// Inverse kinematics by bounded least squares with Ceres. It checks the closed forms as a second algorithm,
// and is a careful one for targets that the joint limits forbid. It is not for the cycle: it allocates and
// takes some hundred microseconds.
#pragma once

#include "nonet/model/inverse_kinematics.h"

namespace nonet::model {

struct NumericSolution {
  double positionError = 0.0;     // m, of the pose reached
  double orientationError = 0.0;  // rad, angle between the orientations; 0 for arms
  /// What the solver minimises: the square root of position error^2 + (kOrientationLever * 2 sin(orientation
  /// error / 2))^2, m.
  double distance = 0.0;
  bool converged = false;
};

/// Goes from `angles`, clamped to the limits first, down to a minimum within the limits.
NumericSolution numericLegInverseKinematics(const RobotModel& model, Side side, const Pose3& X_RS,
                                            LegAngles& angles);

/// The centre of the lower arm as near to p_RH as the limits allow, from `angles`.
NumericSolution numericArmInverseKinematics(const RobotModel& model, Side side, const Vector3& p_RH,
                                            ArmAngles& angles);

}  // namespace nonet::model
