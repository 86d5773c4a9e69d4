// Rotation matrices: the heading in them, and the rotation vectors that make them.
#pragma once

#include <cmath>

#include "nonet/math/types.h"

namespace nonet {

/// Heading of the x axis, rad.
inline double yawOf(const Matrix3& R) {
  return std::atan2(R(1, 0), R(0, 0));
}

inline Matrix3 turnAboutZ(double angle) {
  return Eigen::AngleAxisd(angle, Vector3::UnitZ()).toRotationMatrix();
}

/// The matrix [v] with [v] w = v cross w.
inline Matrix3 skew(const Vector3& v) {
  Matrix3 m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
}

/// The turn about this axis by its length, rad.
inline Matrix3 exponential(const Vector3& rotation) {
  const double angle = rotation.norm();
  if (angle < 1e-12) return Matrix3::Identity() + skew(rotation);
  return Eigen::AngleAxisd(angle, rotation / angle).toRotationMatrix();
}

/// The shortest rotation vector of which it is the exponential.
inline Vector3 logarithm(const Matrix3& R) {
  const Eigen::AngleAxisd turn(R);
  return turn.angle() * turn.axis();
}

}  // namespace nonet
