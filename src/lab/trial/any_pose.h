// A pose drawn at random, for starts that differ.
#pragma once

#include "nonet/math/pose2.h"
#include "nonet/math/random.h"

namespace nonet::lab {

/// Up to 1 ahead and 1 aside, either way, and turned by up to `turned`.
inline Pose2 anyPose(Random& random, double turned) {
  const double rotation = random.uniform(-turned, turned);
  const double y = random.uniform(-1.0, 1.0);
  return {random.uniform(-1.0, 1.0), y, rotation};
}

}  // namespace nonet::lab
