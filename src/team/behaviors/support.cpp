#include "nonet/team/behaviors.h"
#include "nonet/team/goalie.h"
#include "nonet/team/navigation.h"
#include "nonet/team/own_area.h"

#include "team/behaviors/take_place.h"

namespace nonet::team {

namespace {

// The goalie, the nearer back and the one on the ball are the three who may be in the own penalty area: the
// place of the latter is kept for it. While roles change hands the back waits for its predecessor to leave.
bool mayEnterOwnArea(const Situation& s) {
  if (s.role == Role::Goalie || s.role == Role::OnBall) return true;
  const world::PlayerState& onBall = s.world.teammates[static_cast<std::size_t>(s.onBall)];
  const bool inside = s.onBall != 0 && onBall.known && inOwnArea(s.world.field, onBall.X_FP.translation);
  const int others = matesInOwnArea(s.world) - (inside ? 1 : 0);
  return s.role == Role::BackLeft && others <= kMostInOwnArea - 2;
}

}  // namespace

motion::MotionRequest takePlace(const Situation& s, const Vector2& p_FPlace, double wayToBall,
                                std::optional<double> heading) {
  Caution caution;
  caution.robots = s.parameters.avoidDistance;
  caution.ball = s.parameters.avoidDistance;
  caution.wayToBall = wayToBall;
  caution.onBall = s.goalieClaims ? 1 : s.onBall;
  caution.onBallRoom = s.parameters.onBallRoom;
  const Vector2 place = mayEnterOwnArea(s) ? p_FPlace
                                           : aroundOwnArea(s.world.field, s.world.self.X_FR.translation,
                                                           p_FPlace, s.parameters.formation.areaMargin);
  const Pose2 pose(place, heading.value_or(headingTo(s.world, s.ball())));
  return walkTo(s.world, s.parameters.navigation, pose, caution);
}

std::optional<Action> support(const Situation& s) {
  // On the ball, but the goalie plays it, or it may not be touched twice: ready beside it, and out of the way
  // of a clearance.
  if (s.role == Role::OnBall) {
    const Vector2 way = (clearanceTarget(s) - s.ball()).stableNormalized();
    const Vector2 aside = way.y() > 0.0 ? Vector2(way.y(), -way.x()) : Vector2(-way.y(), way.x());
    return Action(takePlace(s, s.ball() + s.parameters.onBallRoom * aside), "beside the ball");
  }
  return Action(takePlace(s, rolePlace(s)), "place of the role");
}

}  // namespace nonet::team
