// Where the referee puts the ball for a set piece.
#pragma once

#include <optional>

#include "nonet/world/world_state.h"

namespace nonet::world {

/// The place where the ball will lie (own field frame), when play stopped with it about at `p_FB`: for
/// kick-ins, corners, goal kicks and free kicks of either team. The ball rolls on for a second before it is
/// put there (server facts 4.7). Nothing in other phases.
std::optional<Vector2> setPieceSpot(Phase phase, const Vector2& p_FB, const FieldGeometry& field);

}  // namespace nonet::world
