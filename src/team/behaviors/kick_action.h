// What behaviours ask of motion when they kick.
#pragma once

#include <cmath>

#include "nonet/team/situation.h"

namespace nonet::team {

/// Near enough, and behind the ball, for motion to take the last steps.
inline bool isBehind(const Situation& s, const BallPlay& play) {
  const BallHandlingParameters& p = s.parameters.ball;
  return play.behind > p.kickBehind && std::abs(play.direction) < p.kickApproach &&
         std::abs(play.besides) < play.behind + p.kickBesides;
}

/// The play's ball to the play's target, with its kick; the cheapest if it names none.
inline Action kickAction(const Situation& s, const BallPlay& play, const char* detail) {
  motion::KickTo request;
  request.ball = play.ball;
  request.target = play.target;
  request.ballVelocity = s.world.self.X_FR.inverse().rotate(s.world.ball.v_FB.head<2>());
  request.room = s.nearestOpponent;
  request.kick.assign(play.kick);
  Action action(request, detail);
  action.reason.candidates = play.candidates;
  return action;
}

}  // namespace nonet::team
