// The shortest way around discs: where to go next so that nobody is run into.
#pragma once

#include <limits>
#include <span>

#include "nonet/math/types.h"

namespace nonet::team {

/// To be walked around. One that holds the start or the end of the way is as small as leaves these free.
struct Disc {
  Vector2 p_F = Vector2::Zero();
  double radius = 0.0;  // m
};

struct Detour {
  Vector2 next = Vector2::Zero();  // the first corner, or the end
  double length = 0.0;             // m, of all pieces
  bool straight = true;            // without a corner
  bool blocked = false;            // some piece cuts a disc: no way was found with few corners
};

/// What turning costs: among ways that begin in different directions a longer one may be better.
struct Facing {
  double direction = 0.0;  // in which the robot faces, rad
  double cost = 0.0;       // of a turn by 1 rad, as m of way
};

/// Straight pieces from `from` to `to`, around either side of each disc in the way. Exact for one disc but
/// for its corner, which lies outside of the arc; greedy for several, at most four corners behind each other.
/// Where that finds no way, or one that is longer by more than `squeezeFor` (m), between the others with less
/// room.
Detour detour(const Vector2& from, const Vector2& to, std::span<const Disc> discs, const Facing& facing = {},
              double squeezeFor = std::numeric_limits<double>::infinity());

}  // namespace nonet::team
