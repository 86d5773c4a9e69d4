#include "nonet/team/touch_watch.h"

#include "nonet/team/pass_mode.h"
#include "nonet/world/set_piece_spot.h"

namespace nonet::team {

bool atMostTwoPlay(const world::WorldState& world) {
  int others = 0;
  for (int unum = 1; unum <= world::kTeamSize; ++unum) {
    const auto index = static_cast<std::size_t>(unum);
    if (unum != world.game.unum && world.teammates[index].known) ++others;
    if (world.opponents[index].known) ++others;
  }
  return others <= 1;
}

void TouchWatch::update(const world::WorldState& world) {
  const world::Phase phase = world.game.phase;
  if (phase != phase_) {
    const bool playOn = phase == world::Phase::PlayOn;
    const bool free = phase_ == world::Phase::OwnKickOff && atMostTwoPlay(world);
    const bool wasOwn = world::isOwnSetPiece(phase_) && !world.game.ballDropped && !free;
    taker_ = playOn && wasOwn ? takerOf(phase_, world) : Kicker{};
    passer_ = playOn && phase_ == world::Phase::OwnPass ? nearestAtBall(world, false) : Kicker{};
    goalKicker_ = {};
    phase_ = phase;
  }
  if (awaitsGoalKick(world)) goalKicker_ = nearestAtBall(world, true);
  const auto passed = [&](const Kicker& kicker, double longest, bool opponentsToo) {
    return world.time - kicker.at > longest || touchedByAnother(world, kicker, opponentsToo);
  };
  if (taker_.unum != 0 && passed(taker_, parameters_.longest, true)) taker_ = {};
  if (passer_.unum != 0 && passed(passer_, kPassModeNoGoal, false)) passer_ = {};
}

// The own goal kick has not been taken: the ball lies where the referee has put it.
bool TouchWatch::awaitsGoalKick(const world::WorldState& world) const {
  constexpr double kAtSpot = 0.3;  // m
  if (world.game.phase != world::Phase::OwnGoalKick) return false;
  const Vector2 ball = world.ball.p_FB.head<2>();
  const auto spot = world::setPieceSpot(world.game.phase, ball, world.field);
  return (*spot - ball).norm() < kAtSpot && world.ball.v_FB.head<2>().norm() < parameters_.resting;
}

// Play goes on with the touch, but at the goal kick not before the ball has left the area.
TouchWatch::Kicker TouchWatch::takerOf(world::Phase piece, const world::WorldState& world) const {
  if (piece == world::Phase::OwnGoalKick) return {goalKicker_.unum, world.time};
  return nearestAtBall(world, true);
}

// Nobody if it is an opponent.
TouchWatch::Kicker TouchWatch::nearestAtBall(const world::WorldState& world, bool opponentsToo) const {
  const Vector2 ball = world.ball.p_FB.head<2>();
  double nearest = parameters_.takerReach;
  Kicker kicker{0, world.time};
  const auto consider = [&](const world::PlayerState& player, int number) {
    const double distance = (player.X_FP.translation - ball).norm();
    if (!player.known || distance > nearest) return;
    nearest = distance;
    kicker.unum = number;
  };
  for (int unum = 1; unum <= world::kTeamSize; ++unum) {
    const auto index = static_cast<std::size_t>(unum);
    consider(world.teammates[index], unum);
    if (opponentsToo) consider(world.opponents[index], 0);
  }
  return kicker;
}

bool TouchWatch::touchedByAnother(const world::WorldState& world, const Kicker& kicker,
                                  bool opponentsToo) const {
  const Vector2 ball = world.ball.p_FB.head<2>();
  const bool turned = world.ball.lastKick > kicker.at + parameters_.turnedAfter &&
                      world.time - world.ball.lastKick < parameters_.turnedFor;
  const double reach = turned ? parameters_.turnedReach : parameters_.touchReach;
  const auto touches = [&](const world::PlayerState& player) {
    return player.known && (player.X_FP.translation - ball).norm() < reach;
  };
  for (int unum = 1; unum <= world::kTeamSize; ++unum) {
    const auto index = static_cast<std::size_t>(unum);
    if (unum != kicker.unum && touches(world.teammates[index])) return true;
    if (opponentsToo && touches(world.opponents[index])) return true;
  }
  return false;
}

}  // namespace nonet::team
