// Vectors as messages have them: rounded to two decimals.
#pragma once

#include "nonet/protocol/rounding.h"
#include "nonet/sim/physics/world.h"

#include "sim/physics/scene.h"

namespace nonet::sim {

inline Vector3 onWire(const Vector3f& v) {
  return {protocol::roundToWire(v.x()), protocol::roundToWire(v.y()), protocol::roundToWire(v.z())};
}

inline Vector3f inDegrees(const Vector3f& radians) {
  return {scene::toDegrees(radians.x()), scene::toDegrees(radians.y()), scene::toDegrees(radians.z())};
}

}  // namespace nonet::sim
