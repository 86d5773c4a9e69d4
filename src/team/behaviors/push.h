// A push at the ball as it would go now.
#pragma once

#include "nonet/math/direction.h"
#include "nonet/team/ball_play.h"
#include "nonet/team/situation.h"

namespace nonet::team {

/// The ball goes where the torso pushes it, whatever the target: would it leave the field?
inline bool pushRollsOut(const Situation& s) {
  const double pushed = directionOf(s.ball() - s.world.self.X_FR.translation);
  return rollsOut(s.world, s.parameters.target, pushed);
}

}  // namespace nonet::team
