#include <algorithm>
#include <cmath>

#include "nonet/math/direction.h"
#include "nonet/team/ball_choice.h"
#include "nonet/team/behaviors.h"
#include "nonet/team/navigation.h"

namespace nonet::team {

namespace {

// Out of the ball's way: beside it, on the side on which the robot is. Who comes after the ball is in
// nobody's way.
Vector2 besideTheWay(const Situation& s, const Vector2& place, const Vector2& rest) {
  const Vector2 ball = s.ball();
  const Vector2 way = rest - ball;
  const double share = (place - ball).dot(way) / std::max(way.squaredNorm(), 1e-9);
  if (share < 0.0 || share > 1.0) return place;  // the ball does not come there
  if ((s.world.self.X_FR.translation - ball).dot(way) < 0.0) return place;
  const Vector2 left = Vector2(-way.y(), way.x()).normalized();
  const double room = s.parameters.ball.awaitAside;
  const double aside = (place - ball).dot(left);
  if (std::abs(aside) > room) return place;
  const double own = (s.world.self.X_FR.translation - ball).dot(left);
  return place + ((own > 0.0 ? room : -room) - aside) * left;
}

}  // namespace

std::optional<Action> awaitBall(const Situation& s) {
  const BallHandlingParameters& p = s.parameters.ball;
  const double speed = s.world.ball.v_FB.head<2>().norm();
  if (!s.play || s.play->wait || s.play->use == KickUse::Never || speed < p.kickRolling) return std::nullopt;
  if (atOwnGoal(s.world)) return std::nullopt;
  const double time = s.forecast.free().slowAfter(p.kickRolling);
  const Vector2 rest = s.forecast.at(time);
  if (!s.world.field.holds(rest) || opponentsTime(s, rest) < time + p.awaitMargin) return std::nullopt;
  const double direction = directionOf(s.play->p_FTarget - rest);
  const Vector2 behind = rest - p.behindBall * unitVector(direction);
  Caution caution;
  caution.robots = s.parameters.avoidDistance;
  const Pose2 place(besideTheWay(s, behind, rest), direction);
  Action action(walkTo(s.world, s.parameters.navigation, place, caution), "where it will rest");
  action.reason.candidates = s.play->candidates;
  return action;
}

}  // namespace nonet::team
