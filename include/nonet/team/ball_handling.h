// What the player on the ball does: go behind it, dribble it, kick it where a kick is of use.
#pragma once

#include "nonet/motion/request.h"
#include "nonet/team/parameters.h"
#include "nonet/world/world_state.h"

namespace nonet::team {

/// What a kick would be for. Dribbling is the rule: to kick, a robot must stand.
enum class KickUse : std::uint8_t {
  Never,
  Shot,   // at a goal within reach
  Clear,  // as far away as it goes
};

/// Goes to the ball, around whoever is in the way, and plays it towards p_FTarget (own field frame).
motion::MotionRequest playBall(const world::WorldState& world, const Vector2& p_FTarget,
                               const TeamParameters& parameters, KickUse use);

/// Waits behind the ball, ready to push it towards p_FTarget.
motion::MotionRequest waitAtBall(const world::WorldState& world, const Vector2& p_FTarget,
                                 const TeamParameters& parameters);

/// Close to the ball: moves it from where it lies towards p_FTarget.
motion::MotionRequest handleBall(const world::WorldState& world, const Vector2& p_FTarget,
                                 const BallHandlingParameters& parameters, KickUse use);

/// Where a dribbled ball should go from its present place: to the goal, around an opponent that stands in
/// the way.
Vector2 ballTarget(const world::WorldState& world);

}  // namespace nonet::team
