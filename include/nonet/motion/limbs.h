// Foot poses and arm attitudes -> joint angles.
#pragma once

#include <array>

#include "nonet/model/inverse_kinematics.h"

namespace nonet::motion {

/// Sole poses X_RS in the torso frame, indexed by model::Side.
using FootPoses = std::array<Pose3, 2>;

constexpr std::size_t index(model::Side side) {
  return static_cast<std::size_t>(side);
}

/// +1 for the left, -1 for the right: the sign of y on that side of the robot.
constexpr double sideSign(model::Side side) {
  return side == model::Side::Left ? 1.0 : -1.0;
}

/// Writes the leg joints. The result is the worse of the two legs.
model::Reach setLegs(const model::RobotModel& model, const FootPoses& feet, model::JointArray& joints);

/// Both arms alike, seen from the left: pitch 0 = forward, -90 degrees = hanging; yaw outwards; elbow bent
/// inwards (all rad).
struct ArmAttitude {
  double pitch = -1.57;
  double yaw = 0.1;
  double roll = 0.0;
  double elbow = 0.0;
};
void setArm(model::Side side, const ArmAttitude& arm, model::JointArray& joints);

}  // namespace nonet::motion
