// Standing somewhere in the formation, clear of the ball and of who plays it, facing the ball.
#pragma once

#include "nonet/motion/request.h"
#include "nonet/team/situation.h"

namespace nonet::team {

/// The way stays as clear of the ball as of robots, or by `wayToBall` (m) if that is more.
motion::MotionRequest takePlace(const Situation& situation, const Vector2& p_FPlace, double wayToBall = 0.0);

/// The place of one's role, own field frame, m; the goalie has none.
inline const Vector2& rolePlace(const Situation& situation) {
  return situation.formation.positions[static_cast<std::size_t>(situation.role)];
}

}  // namespace nonet::team
