// Standing somewhere in the formation, clear of the ball and of who plays it, facing the ball.
#pragma once

#include <optional>

#include "nonet/motion/request.h"
#include "nonet/team/situation.h"

namespace nonet::team {

/// The way stays `ballRoom` (m) clear of the ball; as clear as of robots if none is given.
motion::MotionRequest takePlace(const Situation& situation, const Vector2& p_FPlace,
                                std::optional<double> ballRoom = {});

/// The place of one's role, own field frame, m; the goalie has none.
inline const Vector2& rolePlace(const Situation& situation) {
  return situation.formation.positions[static_cast<std::size_t>(situation.role)];
}

}  // namespace nonet::team
