// Velocities, impulses and inertias of rigid bodies with their linear and angular parts in one vector or
// matrix of six (spatial algebra [Featherstone 2008, chapter 2]). World axes. A body's reference point is
// its centre of mass; an arm leads from there to another point of the body.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <ode/ode.h>

#include "nonet/math/rotation.h"

namespace nonet::sim {

/// Linear, then angular: a velocity (m/s, rad/s) or an impulse (N s, N m s).
using Vector6 = Eigen::Matrix<double, 6, 1>;
/// An inertia takes a velocity to a momentum.
using Matrix6 = Eigen::Matrix<double, 6, 6>;

inline Eigen::Vector3d vectorOf(const dReal* v) {
  return {v[0], v[1], v[2]};
}

inline Eigen::Matrix3d rotationOf(dBodyID body) {
  const dReal* r = dBodyGetRotation(body);
  Eigen::Matrix3d matrix;
  matrix << r[0], r[1], r[2], r[4], r[5], r[6], r[8], r[9], r[10];
  return matrix;
}

/// The velocity of the point at the end of an arm.
[[gnu::always_inline]] inline Vector6 velocityAt(const Vector6& velocity, const Eigen::Vector3d& arm) {
  Vector6 result = velocity;
  result.head<3>() += velocity.tail<3>().cross(arm);
  return result;
}

/// An impulse at the end of an arm, as one on the centre.
[[gnu::always_inline]] inline Vector6 impulseOnCentre(const Vector6& impulse, const Eigen::Vector3d& arm) {
  Vector6 result = impulse;
  result.tail<3>() += arm.cross(impulse.head<3>());
  return result;
}

/// An impulse on the centre, as one at the end of an arm.
[[gnu::always_inline]] inline Vector6 impulseAtEnd(const Vector6& impulse, const Eigen::Vector3d& arm) {
  Vector6 result = impulse;
  result.tail<3>() -= arm.cross(impulse.head<3>());
  return result;
}

/// A unit impulse in this direction at the end of an arm, as one on the centre. Its product with the body's
/// velocity is the speed of that point in this direction.
inline Vector6 unitImpulse(const Eigen::Vector3d& arm, const Eigen::Vector3d& direction) {
  Vector6 row;
  row << direction, arm.cross(direction);
  return row;
}

/// The inertia seen from a point that moves as v' = v + [offset] w: X^T M X with X = [1 [offset]; 0 1].
inline Matrix6 inertiaSeenFrom(const Matrix6& inertia, const Eigen::Matrix3d& offset) {
  using Eigen::Matrix3d;
  const Matrix3d a = inertia.topLeftCorner<3, 3>();
  const Matrix3d b = inertia.topRightCorner<3, 3>();
  const Matrix3d ax = a * offset;
  Matrix6 result;
  result.topLeftCorner<3, 3>() = a;
  const Matrix3d right = ax + b;
  result.topRightCorner<3, 3>() = right;
  result.bottomLeftCorner<3, 3>() = right.transpose();
  const Matrix3d bx = offset.transpose() * b;
  result.bottomRightCorner<3, 3>() =
      offset.transpose() * ax + bx + bx.transpose() + inertia.bottomRightCorner<3, 3>();
  return result;
}

}  // namespace nonet::sim
