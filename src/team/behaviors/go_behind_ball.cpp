#include <cmath>

#include "nonet/math/direction.h"
#include "nonet/team/behaviors.h"

#include "team/behaviors/push.h"

namespace nonet::team {

std::optional<Action> goBehindBall(const Situation& s) {
  if (!s.play) return std::nullopt;
  const BallPlay& play = *s.play;
  const BallHandlingParameters& p = s.parameters.ball;
  const bool careful = play.behind > 0.0 && pushRollsOut(s);
  Vector2 next = play.ball - (careful ? p.standOff : p.behindBall) * play.along;
  // Not behind the ball yet: go around it, on the side on which the robot already is. `behind` of the place
  // itself is behindBall, so a share of it tells the two cases apart without flicker.
  const bool around = play.behind < p.circleBehind * p.behindBall;
  if (around) next += (play.besides > 0.0 ? -1.0 : 1.0) * p.circleRadius * play.aside;
  const bool far = next.norm() > p.faceAway;
  const double heading = far ? directionOf(next) : play.direction;
  Action action(motion::WalkTo{Pose2(next, heading), false}, around ? "around" : "straight");
  action.reason.candidates = play.candidates;
  return action;
}

}  // namespace nonet::team
