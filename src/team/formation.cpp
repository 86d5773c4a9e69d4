#include "nonet/team/formation.h"

#include <algorithm>
#include <cassert>

namespace nonet::team {

Formation formationFor(const Vector2& p_FB, int count, const world::FieldGeometry& field,
                       const FormationParameters& parameters) {
  assert(count >= 0 && count <= kMaxAssigned);
  const Vector2 ownGoal(-0.5 * field.length, 0.0);
  const Vector2 goalToBall = p_FB - ownGoal;
  const double distance = std::max(goalToBall.norm(), 1e-6);
  const Vector2 along = goalToBall / distance;
  const Vector2 aside(-along.y(), along.x());
  // The backs never stand beyond the ball.
  const double nearBack = std::min(parameters.firstBackFromGoal, 0.5 * distance);
  const double farBack = std::min(parameters.secondBackFromGoal, 0.75 * distance);

  const std::array<Vector2, kMaxAssigned> wanted = {
      p_FB,
      p_FB - parameters.stopperBehind * along,
      ownGoal + nearBack * along + parameters.backAside * aside,
      ownGoal + farBack * along - parameters.backAside * aside,
      p_FB + Vector2(-parameters.wingBehind, parameters.wingAside),
      p_FB + Vector2(-parameters.wingBehind, -parameters.wingAside),
      p_FB + Vector2(parameters.forwardAhead, parameters.forwardAside),
      p_FB + Vector2(parameters.forwardAhead, -parameters.forwardAside),
      p_FB - parameters.supporterBehind * along,
      ownGoal + 0.5 * (nearBack + farBack) * along,
  };

  Formation formation;
  formation.count = count;
  const double x = 0.5 * field.length - parameters.touchLineMargin;
  const double y = 0.5 * field.width - parameters.touchLineMargin;
  for (int i = 0; i < count; ++i) {
    const bool isBall = i == 0;  // the one on the ball follows it to the line
    formation.positions[i] =
        isBall ? wanted[i] : Vector2(std::clamp(wanted[i].x(), -x, x), std::clamp(wanted[i].y(), -y, y));
  }
  return formation;
}

Pose2 kickOffPose(int unum, bool ownKickOff, const world::FieldGeometry& field) {
  // For the 30 x 20 field; other sizes are scaled. The kicking side may stand at the ball, the other one must
  // be outside the centre circle (radius 2).
  struct Place {
    double ownX, ownY, otherX, otherY;
  };
  static constexpr std::array<Place, world::kTeamSize> places = {{
      {-14.3, 0.0, -14.3, 0.0},  // goalie
      {-9.0, 2.0, -9.0, 2.0},    // backs
      {-9.0, -2.0, -9.0, -2.0},
      {-4.5, 4.5, -4.5, 4.0},  // wings
      {-4.5, -4.5, -4.5, -4.0},
      {-2.6, 0.8, -2.6, 1.0},  // stopper
      {-0.6, 5.0, -2.6, 3.2},  // forwards
      {-0.6, -5.0, -2.6, -3.2},
      {-0.35, 0.0, -2.6, -1.0},  // on the ball
      {-6.0, 0.0, -6.0, 0.0},
      {-11.0, 0.0, -11.0, 0.0},
  }};
  const Place& place = places[std::clamp(unum, 1, world::kTeamSize) - 1];
  const double scaleX = field.length / 30.0;
  const double scaleY = field.width / 20.0;
  // Distances to the ball and the circle are the same on every field.
  const double x = ownKickOff ? place.ownX : place.otherX;
  const double y = ownKickOff ? place.ownY : place.otherY;
  return {x < -3.0 ? x * scaleX : x, y * scaleY, 0.0};
}

}  // namespace nonet::team
