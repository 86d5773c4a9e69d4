// What the player on the ball does: go behind it, dribble it, kick it where a kick is of use.
#pragma once

#include "nonet/motion/request.h"
#include "nonet/team/parameters.h"
#include "nonet/world/world_state.h"

namespace nonet::team {

/// When to kick instead of dribbling. A kick sends the ball seven metres in a second and a half, but the last
/// steps must go to the right place, which an opponent at the ball does not allow.
enum class KickUse : std::uint8_t {
  Never,
  IfFree,  // no opponent near the ball or in its way
  Clear,   // as soon as no opponent is near the ball
};

/// Goes to the ball, around whoever is in the way, and plays it towards p_FTarget (own field frame).
/// `kicking`: the last request was a kick, too.
motion::MotionRequest playBall(const world::WorldState& world, const Vector2& p_FTarget,
                               const TeamParameters& parameters, KickUse use, bool kicking);

/// Waits behind the ball, ready to push it towards p_FTarget.
motion::MotionRequest waitAtBall(const world::WorldState& world, const Vector2& p_FTarget,
                                 const TeamParameters& parameters);

/// Close to the ball: moves it from where it lies towards p_FTarget.
motion::MotionRequest handleBall(const world::WorldState& world, const Vector2& p_FTarget,
                                 const BallHandlingParameters& parameters, KickUse use, bool kicking = false);

/// Where a dribbled ball should go from its present place: to the goal, around an opponent that stands in
/// the way.
Vector2 ballTarget(const world::WorldState& world);

}  // namespace nonet::team
