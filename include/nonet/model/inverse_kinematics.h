// Closed-form inverse kinematics of the legs and arms, without allocation. An exact solution for a leg takes
// well below 2 microseconds, one at the joint limits some tens (tests/bench/model_bench.cpp).
//
// Method for a leg. The three hip axes meet in one point, and knee and ankle pitch turn in one plane. So the
// place of that point, seen from the foot, gives ankle roll, ankle pitch and knee. The rotation that is left
// belongs to the hip. As its first axis lies at 45 degrees, its angles are Euler angles y-x-y in a frame that
// is rolled by 45 degrees [Graf 2009, section III]. Within the joint limits the solution is unique.
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
/// off, m. That is about the way of the foot's tip in such a turn.
inline constexpr double kOrientationLever = 0.08;

/// Leg joints 1..6 of one side (the toe is not touched), rad.
using LegAngles = std::array<double, 6>;

/// Joint angles that bring the sole frame S (solePose) of `side` to X_RS. The pose fixes all six joints: each
/// leg has a hip yaw-pitch joint of its own, unlike the real Nao, where both share one.
Reach legInverseKinematics(const RobotModel& model, Side side, const Pose3& X_RS, LegAngles& angles);

/// True if legInverseKinematics() would meet the pose exactly; the angles are its answer then. Never fits, so
/// it costs the same everywhere.
bool legReaches(const RobotModel& model, Side side, const Pose3& X_RS, LegAngles& angles);

/// Changes the angles so that the sole goes by `way` (torso frame, m) from where they have it and turns to
/// the left by `yaw` (rad, about the torso's vertical axis): for small ones, by damped Newton steps. Near a
/// stretched leg it goes as far as it can; limits are not looked at.
void shiftSole(const RobotModel& model, Side side, const Vector3& way, double yaw, LegAngles& angles);

/// Writes leg angles into a joint array, and reads them back.
void setLegAngles(Side side, const LegAngles& leg, JointArray& joints);
LegAngles legAngles(Side side, const JointArray& joints);

/// Arm joints 1..4 that bring the centre of the lower arm to p_RH, m. Four joints reach three coordinates in
/// many ways; this is the one within the limits that bends the elbow least.
using ArmAngles = std::array<double, 4>;
Reach armInverseKinematics(const RobotModel& model, Side side, const Vector3& p_RH, ArmAngles& angles);
void setArmAngles(Side side, const ArmAngles& arm, JointArray& joints);

}  // namespace nonet::model
