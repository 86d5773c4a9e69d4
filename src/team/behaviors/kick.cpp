#include <algorithm>
#include <cmath>
#include <limits>

#include "nonet/team/behaviors.h"

namespace nonet::team {

namespace {

// While the robot comes to its stand for the kick it may drift a little.
bool inPlace(const Situation& s) {
  const BallPlay& play = *s.play;
  const BallHandlingParameters& p = s.parameters.ball;
  const double share = s.motion.askedForKick() ? p.kickStay : 1.0;
  return std::abs(play.ball.x() - p.kickAhead) < share * p.kickAheadTolerance &&
         std::abs(std::abs(play.ball.y()) - p.kickAside) < share * p.kickAsideTolerance &&
         std::abs(play.direction) < share * p.kickAngle;
}

bool mayKick(const Situation& s, bool there) {
  const BallHandlingParameters& p = s.parameters.ball;
  const KickUse use = s.play->use;
  if (!p.kick || use == KickUse::Never) return false;
  if (s.world.ball.v_FB.head<2>().norm() > p.kickRolling) return false;
  if (s.nearestOpponent < (there ? p.kickPress : 1.0) * p.kickOpponentDistance) return false;
  if (use == KickUse::Clear || (there && s.motion.askedForKick())) return true;
  const Vector2 from = s.ball();
  const Vector2 way = s.play->p_FTarget - from;
  const Vector2 end = from + std::min(1.0, p.kickLaneLength / std::max(way.norm(), 1e-6)) * way;
  return laneWidth(s.world, from, end, std::numeric_limits<double>::infinity()) > p.kickLane;
}

// The last steps before a kick: to where the ball lies in front of the nearer foot, slowing down.
motion::WalkVelocity lineUp(const BallPlay& play, const BallHandlingParameters& p) {
  constexpr double kNear = 0.01;  // m; from here on the least speed fades, so that it does not jump
  const double foot = play.besides >= 0.0 ? 1.0 : -1.0;
  const Vector2 place = play.ball - p.kickAhead * play.along - foot * p.kickAside * play.aside;
  motion::WalkVelocity request;
  // Small steps may lead nowhere: the least speed keeps a robot from stopping short of its place for ever.
  const Vector2 speed = (p.kickGain + p.kickLeastSpeed / std::max(place.norm(), kNear)) * place;
  request.velocity.translation = speed * std::min(1.0, p.kickMostSpeed / std::max(speed.norm(), 1e-9));
  request.velocity.rotation = p.kickGain * play.direction;
  return request;
}

}  // namespace

std::optional<Action> kick(const Situation& s) {
  if (!s.play) return std::nullopt;
  const BallPlay& play = *s.play;
  const BallHandlingParameters& p = s.parameters.ball;
  const bool there = inPlace(s);
  if (!mayKick(s, there)) return std::nullopt;
  Action action;
  action.reason.candidates = play.candidates;
  if (there) {
    const model::Side foot = play.ball.y() > 0.0 ? model::Side::Left : model::Side::Right;
    action.motion = motion::KickTo{play.ball, play.target, foot};
    action.reason.detail = "in place";
    return action;
  }
  const bool behind = play.behind > p.kickBehind * p.kickAhead && std::abs(play.direction) < p.kickApproach &&
                      std::abs(play.besides) < play.behind + p.kickAside;
  if (!behind) return std::nullopt;
  action.motion = lineUp(play, p);
  action.reason.detail = "line up";
  return action;
}

}  // namespace nonet::team
