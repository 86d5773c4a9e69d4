// Directions in the plane: angles counted from the x axis, rad.
#pragma once

#include <cmath>

#include "nonet/math/types.h"

namespace nonet {

/// Of a vector: in [-pi, pi].
inline double directionOf(const Vector2& way) {
  return std::atan2(way.y(), way.x());
}

/// Of length 1.
inline Vector2 unitVector(double direction) {
  return {std::cos(direction), std::sin(direction)};
}

}  // namespace nonet
