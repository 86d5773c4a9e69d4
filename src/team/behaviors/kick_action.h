// What behaviours ask of motion when they kick.
#pragma once

#include "nonet/team/situation.h"

namespace nonet::team {

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
