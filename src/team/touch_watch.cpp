#include "nonet/team/touch_watch.h"

#include <algorithm>

namespace nonet::team {

namespace {

constexpr double kTakerReach = 1.2;    // m from the ball, in which the taker must be once the mode changes
constexpr double kTouchReach = 0.24;   // m from torso to ball: foot, toe and radius of the ball
constexpr double kTurnedReach = 0.45;  // m, for a ball that changed its way beside somebody
constexpr double kLongest = 12.0;      // s; the mode of the game tells of no touch, so sooner or later the
                                       // ban ends unseen
constexpr double kDropBall = 14.5;  // s after which nobody took the set piece: the referee gave the ball free

}  // namespace

void TouchWatch::update(const world::WorldState& world) {
  const world::Phase phase = world.game.phase;
  if (phase != phase_) {
    const bool wasOwn = world::isOwnSetPiece(phase_) && phase_ != world::Phase::OwnPass;
    taker_ = 0;
    if (phase == world::Phase::PlayOn && wasOwn && world.time - setPieceSince_ < kDropBall) findTaker(world);
    if (world::isOwnSetPiece(phase)) setPieceSince_ = world.time;
    phase_ = phase;
  }
  if (taker_ != 0 && (touchedByAnother(world) || world.time - takenAt_ > kLongest)) taker_ = 0;
}

void TouchWatch::findTaker(const world::WorldState& world) {
  const Vector2 ball = world.ball.p_FB.head<2>();
  double nearest = kTakerReach;
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
  const bool turned = world.ball.lastKick > takenAt_ + 0.5 && world.time - world.ball.lastKick < 0.1;
  const double reach = turned ? kTurnedReach : kTouchReach;
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
