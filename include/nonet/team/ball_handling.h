// What the player on the ball does: go behind it, dribble it, kick it.
#pragma once

#include "nonet/motion/request.h"
#include "nonet/team/parameters.h"
#include "nonet/world/world_state.h"

namespace nonet::team {

/// Moves the ball from where it lies towards p_FTarget (own field frame).
motion::MotionRequest handleBall(const world::WorldState& world, const Vector2& p_FTarget,
                                 const BallHandlingParameters& parameters);

/// Where the ball should go from its present place: the opponent's goal, away from the goalkeeper's corner of
/// it.
Vector2 ballTarget(const world::WorldState& world);

}  // namespace nonet::team
