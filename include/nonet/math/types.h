// Short names for the vectors and poses used everywhere. SI units; angles in radians.
//
// Monogram notation (after Drake): p_FB is the position of B in frame F, X_FR the pose of R in F, R_FR its
// rotation, v_FB a velocity. F is the field (x to the opponent's goal, y left, z up), R the robot's torso
// (x forward, y left, z up), C the camera (x forward, y left, z up).
#pragma once

#include <Eigen/Geometry>

namespace nonet {

using Vector2 = Eigen::Vector2d;
using Vector3 = Eigen::Vector3d;
using Matrix2 = Eigen::Matrix2d;
using Matrix3 = Eigen::Matrix3d;
using Pose3 = Eigen::Isometry3d;

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double kGravity = 9.81;    // m/s^2, of the server's world
inline constexpr double kCycleTime = 0.02;  // s, one simulation step

}  // namespace nonet
