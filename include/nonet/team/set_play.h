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

/// An own set piece has begun, and the referee has not put the ball yet: a touch does not count, and then it
/// pushes who is nearer than half a metre out to that (server facts 4.7). At the kick-off the ball lies
/// there.
bool ballNotPut(const world::WorldState& world);
constexpr double kUntilPut = 0.55;  // m that the taker keeps from the ball

}  // namespace nonet::team
