#include "nonet/team/touch_watch.h"

#include <algorithm>

namespace nonet::team {

void TouchWatch::update(const world::WorldState& world) {
  const world::Phase phase = world.game.phase;
  if (phase != phase_) {
    const bool wasOwn = world::isOwnSetPiece(phase_) && phase_ != world::Phase::OwnPass;
    taker_ = 0;
    if (phase == world::Phase::PlayOn && wasOwn && !world.game.ballDropped) findTaker(world);
    phase_ = phase;
  }
  if (taker_ != 0 && (touchedByAnother(world) || world.time - takenAt_ > parameters_.longest)) taker_ = 0;
}

void TouchWatch::findTaker(const world::WorldState& world) {
  const Vector2 ball = world.ball.p_FB.head<2>();
  double nearest = parameters_.takerReach;
  const auto consider = [&](const world::PlayerState& player, int number) {
    const double distance = (player.X_FP.translation - ball).norm();
    if (!player.known || distance > nearest) return;
    nearest = distance;
    taker_ = number;
  };
  for (int unum = 1; unum <= world::kTeamSize; ++unum) {
    const auto index = static_cast<std::size_t>(unum);
    consider(world.teammates[index], unum);
    consider(world.opponents[index], 0);  // an opponent may have been first
  }
  takenAt_ = world.time;
}

bool TouchWatch::touchedByAnother(const world::WorldState& world) const {
  const Vector2 ball = world.ball.p_FB.head<2>();
  const bool turned = world.ball.lastKick > takenAt_ + parameters_.turnedAfter &&
                      world.time - world.ball.lastKick < parameters_.turnedFor;
  const double reach = turned ? parameters_.turnedReach : parameters_.touchReach;
  const auto touches = [&](const world::PlayerState& player) {
    return player.known && (player.X_FP.translation - ball).norm() < reach;
  };
  for (int unum = 1; unum <= world::kTeamSize; ++unum) {
    const auto index = static_cast<std::size_t>(unum);
    if (unum != taker_ && touches(world.teammates[index])) return true;
    if (touches(world.opponents[index])) return true;
  }
  return false;
}

}  // namespace nonet::team
