// Own kick-offs, kick-ins, corners, goal kicks and free kicks: the taker pushes the ball once to a receiver
// that stands near by, since it may not touch it twice; at the kick-off it kicks.
#pragma once

#include "nonet/team/parameters.h"
#include "nonet/world/world_state.h"

namespace nonet::team {

/// The plan for one set piece, own field frame.
struct SetPlay {
  Vector2 p_FReceiver = Vector2::Zero();  // where the receiver waits, m
  Vector2 p_FTarget = Vector2::Zero();    // where the taker pushes the ball: before the receiver's feet, m
  bool kicked = false;  // the ball is to go just so far; otherwise the target is a direction
};

SetPlay setPlayFor(world::Phase phase, const Vector2& p_FB, const world::FieldGeometry& field,
                   const SetPlayParameters& parameters);

}  // namespace nonet::team
