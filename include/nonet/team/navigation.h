// Going to a place on the field without running into anybody.
#pragma once

#include "nonet/math/pose2.h"
#include "nonet/motion/request.h"
#include "nonet/world/world_state.h"

namespace nonet::team {

/// A walk to X_FTarget (own field frame). Far away the robot faces its way, near by it takes the target's
/// heading. The way bends around known robots that are within `avoidDistance` of it.
motion::MotionRequest walkTo(const world::WorldState& world, const Pose2& X_FTarget, double avoidDistance);

/// Heading from the robot to a point of the field, in the field frame, rad.
double headingTo(const world::WorldState& world, const Vector2& p_F);

}  // namespace nonet::team
