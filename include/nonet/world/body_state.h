// What the robot knows of its own body: joints, torso orientation, contacts, posture, odometry.
#pragma once

#include <array>

#include "nonet/math/pose2.h"
#include "nonet/math/types.h"
#include "nonet/model/kinematics.h"

namespace nonet::world {

enum class Posture : std::uint8_t { Upright, Falling, FallenFront, FallenBack, FallenLeft, FallenRight };
constexpr bool isFallen(Posture posture) {
  return posture >= Posture::FallenFront;
}

struct BodyState {
  double time = 0.0;           // server time of the message, s
  double cycleTime = 0.0;      // s since the previous message (a multiple of 0.02 when messages were lost)
  model::JointArray joints{};  // measured, rad
  model::JointArray jointSpeeds{};                   // finite difference over the last cycle, rad/s
  model::BodyPoses bodies = model::identityPoses();  // X_RB from the measured joints
  Vector3 p_RCom = Vector3::Zero();                  // centre of mass, m
  Vector3 gyro = Vector3::Zero();                    // rad/s, robot axes
  Vector3 accelerometer = Vector3::Zero();           // m/s^2, robot axes, one cycle older
  Matrix3 R_GR =
      Matrix3::Identity();  // torso orientation in a level frame G whose heading drifts (gyro integrated)
  double roll = 0.0;        // rad, positive = leaning to the right
  double pitch = 0.0;       // rad, positive = leaning forward
  double yaw = 0.0;         // rad, of G: only differences mean something
  std::array<bool, 2> footContact{};  // indexed by model::Side
  std::array<Vector3, 2> footForce{Vector3::Zero(),
                                   Vector3::Zero()};  // N, robot axes of the foot; 0 without contact
  Posture posture = Posture::Upright;
  double postureSince = 0.0;       // server time at which the posture began, s
  double torsoHeight = 0.0;        // m above the ground, from the supporting foot's kinematics
  Vector3 v_GR = Vector3::Zero();  // velocity of the torso centre, m/s, axes of G
  Vector3 p_GR = Vector3::Zero();  // torso centre, m: x, y relative to its place at the start, drifting;
                                   // z above the ground
  bool putUpright = false;         // the server has just done so: a beam
  bool asleep = false;             // the server froze the still robot: its senses repeat (server facts 3.4)
  Pose2 odometry;                  // torso pose on the ground since the start, drifting
  Pose2 odometryStep;              // change in this cycle, in the previous cycle's robot frame
};

}  // namespace nonet::world
