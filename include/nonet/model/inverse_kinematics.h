// Closed-form inverse kinematics of the legs and arms. No allocation; an exact leg solution costs well below
// 2 microseconds (tests/bench/model_bench.cpp), one at the joint limits some tens.
//
// Method, leg: the three hip axes meet in the hip's centre, and knee and ankle pitch turn in one plane. Seen
// from the foot, the hip's place therefore gives ankle roll, knee and ankle pitch; what rotation is left is
// split about the hip's axes: the 45 degree yaw-pitch axis makes them Euler angles y-x-y in a frame rolled by
// 45 degrees [Graf 2009, section III]. Within the joint limits the solution is unique.
#pragma once

#include "nonet/math/types.h"
#include "nonet/model/robot_model.h"

namespace nonet::model {

/// How well a target was met. The angles returned are always within the joint limits.
enum class Reach : std::uint8_t {
  Exact,    // the pose is met
  Limited,  // a joint limit binds: the nearest pose within the limits (a local least-squares fit)
  TooFar,   // beyond the stretched limb: stretched towards it, the foot's orientation kept if limits allow
};

/// Where no exact solution exists, a foot that is turned by one radian counts as much as one that is this far
/// off, m. It is about what the tip of the foot then moves by.
inline constexpr double kOrientationLever = 0.08;

/// Leg joints 1..6 of one side (the toe is not touched), rad.
using LegAngles = std::array<double, 6>;

/// Joint angles that bring the sole frame S (solePose) of `side` to X_RS. The foot's six degrees of freedom
/// fix all six joints; the 45 degree hip yaw-pitch joint of each leg is its own here.
Reach legInverseKinematics(const RobotModel& model, Side side, const Pose3& X_RS, LegAngles& angles);

/// Writes leg angles into a joint array, and reads them back.
void setLegAngles(Side side, const LegAngles& leg, JointArray& joints);
LegAngles legAngles(Side side, const JointArray& joints);

/// Arm joints 1..4 that bring the centre of the lower arm to p_RH, m. Four joints for three coordinates: of
/// all solutions within the limits it gives the one with the elbow bent least.
using ArmAngles = std::array<double, 4>;
Reach armInverseKinematics(const RobotModel& model, Side side, const Vector3& p_RH, ArmAngles& angles);
void setArmAngles(Side side, const ArmAngles& arm, JointArray& joints);

}  // namespace nonet::model
