// The 32-bit arithmetic of the server's scene tree. The order of the operations is the server's: these
// numbers go back into the physics (moves, drag) and out to the sensors, so each rounding counts.
#pragma once

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include <ode/ode.h>

#include "nonet/sim/physics/world.h"

namespace nonet::sim::scene {

using Matrix3f = Eigen::Matrix3f;

/// The extents of a box of the model (x forward, y left) in the server's axes (x right, y forward).
inline Vector3 extentsInServerAxes(const Vector3& extents) {
  return {extents.y(), extents.x(), extents.z()};
}

/// A number computed in a scene description: it is handed on as text with six significant digits of a 32-bit
/// float.
inline double scriptNumber(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%g", static_cast<double>(static_cast<float>(value)));
  return std::strtod(text, nullptr) + 0.0;  // + 0.0: no negative zero
}

inline Vector3f scriptVector(const Vector3& v) {
  return {static_cast<float>(scriptNumber(v.x())), static_cast<float>(scriptNumber(v.y())),
          static_cast<float>(scriptNumber(v.z()))};
}

inline float toRadians(float degrees) {
  return static_cast<float>(degrees * (M_PI / 180.0));
}
inline float toDegrees(float radians) {
  return static_cast<float>(radians * (180.0 / M_PI));
}

inline Vector3f rotate(const Matrix3f& r, const Vector3f& v) {
  return {v.x() * r(0, 0) + v.y() * r(0, 1) + v.z() * r(0, 2),
          v.x() * r(1, 0) + v.y() * r(1, 1) + v.z() * r(1, 2),
          v.x() * r(2, 0) + v.y() * r(2, 1) + v.z() * r(2, 2)};
}

inline Vector3f inverseRotate(const Matrix3f& r, const Vector3f& v) {
  return {v.x() * r(0, 0) + v.y() * r(1, 0) + v.z() * r(2, 0),
          v.x() * r(0, 1) + v.y() * r(1, 1) + v.z() * r(2, 1),
          v.x() * r(0, 2) + v.y() * r(1, 2) + v.z() * r(2, 2)};
}

inline Vector3f transform(const ScenePose& pose, const Vector3f& v) {
  const Matrix3f& r = pose.rotation;
  const Vector3f& p = pose.position;
  return {v.x() * r(0, 0) + v.y() * r(0, 1) + v.z() * r(0, 2) + p.x(),
          v.x() * r(1, 0) + v.y() * r(1, 1) + v.z() * r(1, 2) + p.y(),
          v.x() * r(2, 0) + v.y() * r(2, 1) + v.z() * r(2, 2) + p.z()};
}

/// The point in the frame of `pose`: the inverse pose is computed first, as a matrix, then applied.
inline Vector3f inverseTransform(const ScenePose& pose, const Vector3f& v) {
  const ScenePose inverse{pose.rotation.transpose(), -inverseRotate(pose.rotation, pose.position)};
  return transform(inverse, v);
}

/// A direction in the frame of `r`, by way of the inverse matrix with its (zero) position: this differs from
/// inverseRotate() in the sign of zeros, which messages show as "-0.00".
inline Vector3f inverseDirection(const Matrix3f& r, const Vector3f& v) {
  return inverseTransform(ScenePose{r, Vector3f::Zero()}, v);
}

inline Matrix3f multiply(const Matrix3f& a, const Matrix3f& b) {
  Matrix3f product;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) product(i, j) = a(i, 0) * b(0, j) + a(i, 1) * b(1, j) + a(i, 2) * b(2, j);
  }
  return product;
}

inline Matrix3f rotationZ(float radians) {
  const auto c = static_cast<float>(std::cos(radians));
  const auto s = static_cast<float>(std::sin(radians));
  Matrix3f r = Matrix3f::Identity();
  r(0, 0) = c;
  r(1, 0) = s;
  r(0, 1) = -s;
  r(1, 1) = c;
  return r;
}

inline float length(const Vector3f& v) {
  float sum = v.x() * v.x();
  sum += v.y() * v.y();
  sum += v.z() * v.z();
  return std::sqrt(sum);
}

/// The rotation as ODE wants it: rows of four.
inline void toOde(const Matrix3f& r, dMatrix3 matrix) {
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) matrix[4 * row + column] = r(row, column);
    matrix[4 * row + 3] = 0.0;
  }
}

inline Vector3f fromOde(const dReal* v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

inline Matrix3f rotationFromOde(const dReal* matrix) {
  Matrix3f r;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      r(row, column) = static_cast<float>(matrix[4 * row + column]);
    }
  }
  return r;
}

}  // namespace nonet::sim::scene
