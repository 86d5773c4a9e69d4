// Standing somewhere in the formation, clear of the ball and of who plays it.
#pragma once

#include <optional>

#include "nonet/motion/request.h"
#include "nonet/team/situation.h"

namespace nonet::team {

/// The way stays as clear of the ball as of robots, or by `wayToBall` (m) if that is more. `heading`: own
/// field frame, rad; without one the robot faces the ball.
motion::MotionRequest takePlace(const Situation& situation, const Vector2& p_FPlace, double wayToBall = 0.0,
                                std::optional<double> heading = std::nullopt);

/// The place of one's role, own field frame, m; the goalie has none.
inline const Vector2& rolePlace(const Situation& situation) {
  return situation.formation.positions[static_cast<std::size_t>(situation.role)];
}

}  // namespace nonet::team
