#include "nonet/team/set_play.h"

#include <algorithm>
#include <cmath>

#include "nonet/math/angle.h"

namespace nonet::team {

namespace {

constexpr double kPassLength = 1.3;   // m, a little more than the ball rolls after a push by a walking foot
constexpr double kBehindPass = 0.45;  // m, the receiver waits on the own side of the way of the ball
constexpr double kKickInAngle = toRadians(65);  // from the touch line into the field
constexpr double kGoalKickAngle = toRadians(35);

// To the right and a little back, to a receiver away from the opponents.
constexpr double kKickOffAngle = toRadians(-100);

// Into the field rather than along its edge.
double direction(world::Phase phase, const Vector2& p_FB, const world::FieldGeometry& field) {
  const double inwards = p_FB.y() > 0.0 ? -1.0 : 1.0;
  switch (phase) {
    case world::Phase::OwnKickOff:
      return kKickOffAngle;
    case world::Phase::OwnKickIn:
      return inwards * kKickInAngle;
    case world::Phase::OwnCorner: {
      const Vector2 way = Vector2(0.5 * field.length - 2.0, 0.0) - p_FB;
      return std::atan2(way.y(), way.x());
    }
    case world::Phase::OwnGoalKick:
      return inwards * kGoalKickAngle;
    default: {
      const Vector2 way = Vector2(0.5 * field.length, 0.0) - p_FB;
      return std::atan2(way.y(), way.x());
    }
  }
}

}  // namespace

double kickOffPassAngle() {
  return kKickOffAngle;
}

SetPlay setPlayFor(world::Phase phase, const Vector2& p_FB, const world::FieldGeometry& field) {
  const double angle = direction(phase, p_FB, field);
  const Vector2 along(std::cos(angle), std::sin(angle));
  SetPlay play;
  play.p_FTarget = p_FB + 2.0 * kPassLength * along;
  play.p_FReceiver = p_FB + kPassLength * along - Vector2(kBehindPass, 0.0);
  const double edge = 0.5 * field.width - 0.3;
  play.p_FReceiver.y() = std::clamp(play.p_FReceiver.y(), -edge, edge);
  return play;
}

}  // namespace nonet::team
