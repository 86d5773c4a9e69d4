// A pose in the plane: position and heading. Composition as for rigid transforms: X_AC = X_AB * X_BC.
#pragma once

#include "nonet/math/angle.h"
#include "nonet/math/types.h"

namespace nonet {

struct Pose2 {
  Vector2 translation = Vector2::Zero();  // m
  double rotation = 0.0;                  // rad, counter-clockwise from the x axis

  Pose2() = default;
  Pose2(const Vector2& p, double angle) : translation(p), rotation(angle) {}
  Pose2(double x, double y, double angle) : translation(x, y), rotation(angle) {}

  Pose2 operator*(const Pose2& other) const {
    return {*this * other.translation, wrapAngle(rotation + other.rotation)};
  }
  Vector2 operator*(const Vector2& point) const { return translation + rotate(point); }
  Pose2 inverse() const {
    const Eigen::Rotation2Dd back(-rotation);
    return {-(back * translation), wrapAngle(-rotation)};
  }
  /// Turns a direction (no translation).
  Vector2 rotate(const Vector2& direction) const { return Eigen::Rotation2Dd(rotation) * direction; }
};

}  // namespace nonet
