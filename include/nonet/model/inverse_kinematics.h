// Closed-form inverse kinematics of the legs and arms.
#pragma once

#include "nonet/math/types.h"
#include "nonet/model/robot_model.h"

namespace nonet::model {

/// How well a target was met. The angles returned are always within the joint limits.
enum class Reach : std::uint8_t {
  Exact,    // the pose is met
  Limited,  // a joint limit binds: the nearest pose found by clamping
  TooFar,   // beyond the stretched leg: the leg is stretched towards it
};

/// Leg joints 1..6 of one side (the toe is not touched), rad.
using LegAngles = std::array<double, 6>;

/// Joint angles that bring the sole frame S (solePose) of `side` to X_RS. The foot's six degrees of freedom
/// fix all six joints; the 45 degree hip yaw-pitch joint of each leg is its own here.
Reach legInverseKinematics(const RobotModel& model, Side side, const Pose3& X_RS, LegAngles& angles);

/// Writes leg angles into a joint array, and reads them back.
void setLegAngles(Side side, const LegAngles& leg, JointArray& joints);
LegAngles legAngles(Side side, const JointArray& joints);

/// Arm joints 1..4 that bring the centre of the lower arm to p_RH. The elbow is bent as little as possible.
using ArmAngles = std::array<double, 4>;
Reach armInverseKinematics(const RobotModel& model, Side side, const Vector3& p_RH, ArmAngles& angles);
void setArmAngles(Side side, const ArmAngles& arm, JointArray& joints);

}  // namespace nonet::model
