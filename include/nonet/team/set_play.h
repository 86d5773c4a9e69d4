// Own kick-offs, kick-ins, corners, goal kicks and free kicks: the taker kicks the ball once to a receiver,
// since it may not touch it twice, and who walks into it often does.
#pragma once

#include "nonet/team/parameters.h"
#include "nonet/world/world_state.h"

namespace nonet::team {

/// The plan for one set piece, own field frame.
struct SetPlay {
  Vector2 p_FReceiver = Vector2::Zero();  // where the receiver waits, m
  Vector2 p_FTarget = Vector2::Zero();    // where the ball is to rest: before the receiver's feet, m
};

SetPlay setPlayFor(world::Phase phase, const Vector2& p_FB, const world::FieldGeometry& field,
                   const SetPlayParameters& parameters);

}  // namespace nonet::team
