// What behaviours ask of motion when they kick, and what it was asked for last.
#pragma once

#include <variant>

#include "nonet/team/situation.h"

namespace nonet::team {

/// Motion was asked for a kick last, to be stopped by nobody, and the ball is within so many metres.
inline bool kickUnderWay(const Situation& s, double within) {
  const auto* kick = std::get_if<motion::KickTo>(&s.motion.request);
  return kick != nullptr && !kick->stops && s.play->ball.norm() <= within;
}

/// The play's ball to the play's target, with its kick; the cheapest if it names none.
inline Action kickAction(const Situation& s, const BallPlay& play, const char* detail) {
  motion::KickTo request;
  request.ball = play.ball;
  request.target = play.target;
  request.ballVelocity = s.ballVelocity();
  request.room = s.nearestOpponent;
  request.kick.assign(play.kick);
  Action action(request, detail);
  action.reason.candidates = play.candidates;
  return action;
}

}  // namespace nonet::team
