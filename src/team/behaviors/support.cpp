#include "nonet/team/behaviors.h"
#include "nonet/team/navigation.h"

#include "team/behaviors/take_place.h"

namespace nonet::team {

motion::MotionRequest takePlace(const Situation& s, const Vector2& p_FPlace) {
  Caution caution;
  caution.robots = s.parameters.avoidDistance;
  caution.ball = s.parameters.avoidDistance;
  caution.onBall = s.goalieClaims ? 1 : s.onBall;
  caution.onBallRoom = s.parameters.onBallRoom;
  const Pose2 pose(p_FPlace, headingTo(s.world, s.ball()));
  return walkTo(s.world, s.parameters.navigation, pose, caution);
}

std::optional<Action> support(const Situation& s) {
  // On the ball, but another plays it: ready beside that one.
  if (s.role == Role::OnBall)
    return Action(takePlace(s, s.ball() + Vector2(s.parameters.onBallRoom, 0.0)), "beside the ball");
  return Action(takePlace(s, rolePlace(s)), "place of the role");
}

}  // namespace nonet::team
