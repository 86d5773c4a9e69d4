// What the rules measure: areas of the field, and the extent of a robot in the two ways the server has for it
// (server facts 4.8). World axes, metres, 32-bit as in the server.
#pragma once

#include <Eigen/Core>

#include "nonet/sim/physics/world.h"
#include "nonet/sim/settings/settings.h"

namespace nonet::sim {

using Vector2f = Eigen::Vector2f;

struct Box2 {
  Vector2f low = Vector2f::Constant(1e30F);
  Vector2f high = Vector2f::Constant(-1e30F);

  void include(const Vector2f& point) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  void move(const Vector2f& by) {
    low += by;
    high += by;
  }
  /// Borders belong to the box.
  bool contains(const Vector2f& p) const {
    return p.x() >= low.x() && p.x() <= high.x() && p.y() >= low.y() && p.y() <= high.y();
  }
  bool meets(const Box2& other) const {
    return low.x() <= other.high.x() && high.x() >= other.low.x() && low.y() <= other.high.y() &&
           high.y() >= other.low.y();
  }
};

struct Box3 {
  Vector3f low = Vector3f::Constant(1e30F);
  Vector3f high = Vector3f::Constant(-1e30F);

  void include(const Vector3f& point) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  void move(const Vector3f& by) {
    low += by;
    high += by;
  }
};

/// The unit vector of this direction; zero for the zero vector.
inline Vector2f directionOf(const Vector2f& v) {
  const float length = v.norm();
  return length > 0.0F ? Vector2f(v / length) : v;
}

bool sphereMeetsBox(const Vector3f& center, float radius, const Box3& box);

/// The parts of the field that rules speak of. The halves reach 10 m beyond the field.
struct FieldAreas {
  explicit FieldAreas(const Settings& settings);
  const Box2& penaltyArea(bool left) const { return left ? leftPenaltyArea : rightPenaltyArea; }
  /// A place inside a penalty area is moved to the nearest of its front corners.
  void moveOutOfPenaltyArea(Vector3f& position) const;

  Box2 leftHalf;
  Box2 rightHalf;
  Box2 leftPenaltyArea;
  Box2 rightPenaltyArea;
};

/// The axis-parallel box around everything that is drawn of a robot, the invisible selection disc of radius
/// 0.2 m around the torso included, where it is now (poses of the last step, moved with the torso). Used for
/// clearing circles and for finding free places.
Box3 drawnBox(const World& world, RobotHandle robot);

/// The rectangle around the centres of all parts that have colliders. Used for clearing halves and areas.
Box2 colliderRectangle(const World& world, RobotHandle robot);

}  // namespace nonet::sim
