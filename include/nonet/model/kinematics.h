// Forward kinematics: every body's pose in the torso frame R from the joint angles; camera, soles, centre of
// mass.
#pragma once

#include <array>

#include "nonet/math/types.h"
#include "nonet/model/robot_model.h"

namespace nonet::model {

/// X_RB of every body B, indexed by BodyId; bodies that a type lacks are the identity.
using BodyPoses = std::array<Pose3, kBodyCount>;

/// All of them the identity: Eigen leaves poses that nobody sets uninitialised.
inline BodyPoses identityPoses() {
  BodyPoses poses;
  poses.fill(Pose3::Identity());
  return poses;
}

void forwardKinematics(const RobotModel& model, const JointArray& angles, BodyPoses& poses);

/// p_RCom, m.
Vector3 centerOfMass(const RobotModel& model, const BodyPoses& poses);

/// X_RC: the camera is the centre of the head, looking along x.
inline const Pose3& cameraPose(const BodyPoses& poses) {
  return poses[index(BodyId::Head)];
}

/// X_RS: the point of the sole below the ankle (S: x forward, y left, z up), m. The sole is level with the
/// foot's bottom face; on type 4 it includes the toe.
Pose3 solePose(const RobotModel& model, const BodyPoses& poses, Side side);

}  // namespace nonet::model
