#include <algorithm>
#include <cmath>

#include "nonet/math/direction.h"
#include "nonet/team/behaviors.h"

#include "team/behaviors/push.h"

namespace nonet::team {

namespace {

// An opponent stands on the straight way from here to this place (robot frame, m).
bool blocked(const Situation& s, const Vector2& place) {
  const Pose2 X_RF = s.world.self.X_FR.inverse();
  const double length = std::max(place.norm(), 1e-6);
  const Vector2 along = place / length;
  for (const world::PlayerState& opponent : s.world.opponents) {
    if (!opponent.known) continue;
    const Vector2 p_RO = X_RF * opponent.X_FP.translation;
    const double ahead = std::clamp(p_RO.dot(along), 0.0, length);
    const bool before = p_RO.dot(along) > 0.0;
    if (before && (p_RO - ahead * along).norm() < s.parameters.ball.circleRoom) return true;
  }
  return false;
}

// 1: with the ball on the right hand; -1: on the left. On the side where the robot is, unless an opponent
// stands in that way and the other one is free, and hardly longer.
double sideAround(const Situation& s, const Vector2& behind) {
  const BallHandlingParameters& p = s.parameters.ball;
  const double side = s.play->besides > 0.0 ? -1.0 : 1.0;
  const Vector2 way = p.circleRadius * s.play->aside;
  const bool either = std::abs(s.play->besides) < p.circleEither;
  return either && blocked(s, behind + side * way) && !blocked(s, behind - side * way) ? -side : side;
}

}  // namespace

std::optional<Action> goBehindBall(const Situation& s) {
  if (!s.play) return std::nullopt;
  const BallPlay& play = *s.play;
  const BallHandlingParameters& p = s.parameters.ball;
  const bool careful = play.behind > 0.0 && pushRollsOut(s);
  Vector2 next = play.ball - (careful ? p.standOff : p.behindBall) * play.along;
  // Not behind the ball yet: go around it, on the side on which the robot already is. `behind` of the place
  // itself is behindBall, so a share of it tells the two cases apart without flicker.
  const bool around = play.behind < p.circleBehind * p.behindBall;
  if (around) next += sideAround(s, next) * p.circleRadius * play.aside;
  const bool far = next.norm() > p.faceAway;
  const double heading = far ? directionOf(next) : play.direction;
  Action action(motion::WalkTo{Pose2(next, heading), false}, around ? "around" : "straight");
  action.reason.candidates = play.candidates;
  return action;
}

}  // namespace nonet::team
