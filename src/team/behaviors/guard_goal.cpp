#include "nonet/team/behaviors.h"
#include "nonet/team/goalie.h"
#include "nonet/team/navigation.h"

namespace nonet::team {

std::optional<Action> guardGoal(const Situation& s) {
  if (s.role != Role::Goalie) return std::nullopt;
  const GoalieParameters& p = s.parameters.goalie;
  // A ball on its way to the goal is met where it will pass, by steps aside and back: the eyes stay on it.
  if (const std::optional<ComingShot> shot = comingShot(s)) {
    const Vector2 steps = p.meetRate * Vector2(-shot->back, shot->aside);
    return Action(motion::WalkVelocity{Pose2(steps, 0.0)},
                  shot->back > 0.0 ? "under the lob" : "meet the ball");
  }
  Caution caution;
  caution.robots = p.room;
  caution.ball = s.mayTouch ? 0.0 : p.room;
  // A ball that it has behind it is not pushed into the own goal on the way back.
  const Vector2 goal = s.world.field.ownGoal();
  const double own = (s.world.self.X_FR.translation - goal).norm();
  if ((s.ball() - goal).norm() < own) caution.wayToBall = p.room;
  const double clear = world::isOpponentSetPiece(s.phase()) ? s.clearOfOpponentKick() : 0.0;
  const Pose2 place = guardPlace(s.ball(), s.world.field, p, clear);
  const Pose2 pose(place.translation, headingTo(s.world, s.ball()));
  return Action(walkTo(s.world, s.parameters.navigation, pose, caution), "angle");
}

}  // namespace nonet::team
