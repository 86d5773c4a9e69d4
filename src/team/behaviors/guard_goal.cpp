#include <algorithm>

#include "nonet/team/behaviors.h"
#include "nonet/team/navigation.h"
#include "nonet/world/ball_law.h"

namespace nonet::team {

std::optional<Action> guardGoal(const Situation& s) {
  if (s.role != Role::Goalie) return std::nullopt;
  const GoalieParameters& p = s.parameters.goalie;
  const Vector2 goal(-0.5 * s.world.field.length, 0.0);
  Vector2 place = goal + p.outOfGoal * (s.ball() - goal).normalized();
  place.x() = std::max(place.x(), goal.x() + p.inFrontOfLine);
  // A ball on its way to the goal is met where it will pass.
  const auto passing = world::crossingOfLine({s.world.ball.p_FB, s.world.ball.v_FB}, place.x());
  const double side = 0.5 * s.world.field.goalWidth;
  const bool comes = passing && s.world.ball.v_FB.x() < -p.rollingSpeed;
  if (comes) place.y() = std::clamp(passing->y, -side, side);
  Caution caution;
  caution.robots = p.room;
  caution.ball = s.mayTouch ? 0.0 : p.room;
  const Pose2 pose(place, headingTo(s.world, s.ball()));
  return Action(walkTo(s.world, s.parameters.navigation, pose, caution), comes ? "meet the ball" : "angle");
}

}  // namespace nonet::team
