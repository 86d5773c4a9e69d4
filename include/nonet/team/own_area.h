// The own penalty area, which must not hold more than three of the own team (illegal defence, server
// facts 4.10).
#pragma once

#include "nonet/world/world_state.h"

namespace nonet::team {

inline constexpr int kMostInOwnArea = 3;

/// Whether a place (own field frame) is in the own penalty area made larger by `margin` (m) on its open
/// sides.
bool inOwnArea(const world::FieldGeometry& field, const Vector2& p_F, double margin = 0.0);

/// How many team mates, without oneself, are in the own penalty area, as far as one knows.
int matesInOwnArea(const world::WorldState& world);

/// The next place on the shortest way from `p_FStart` to `p_FTarget` around the own penalty area, made larger
/// by `margin`: the target itself where the way is clear, or where one must go through the area since one is
/// deep in it. A target in the area is moved to its nearest edge.
Vector2 aroundOwnArea(const world::FieldGeometry& field, const Vector2& p_FStart, Vector2 p_FTarget,
                      double margin);

}  // namespace nonet::team
