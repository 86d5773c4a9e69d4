#include "nonet/world/set_piece_spot.h"

#include <algorithm>
#include <cmath>

#include "nonet/model/ball.h"

namespace nonet::world {

namespace {

constexpr double kGoalKick = 1.0;  // m before the goal line

// Inside a penalty area it lies at the nearest of that area's front corners.
Vector2 freeKickSpot(const Vector2& p_FB, const FieldGeometry& field) {
  const double front = field.goalLine() - field.areaLength;
  const double side = 0.5 * field.areaWidth;
  if (std::abs(p_FB.x()) < front || std::abs(p_FB.y()) > side) return p_FB;
  return {std::copysign(front, p_FB.x()), std::copysign(side, p_FB.y())};
}

}  // namespace

std::optional<Vector2> setPieceSpot(Phase phase, const Vector2& p_FB, const FieldGeometry& field) {
  const double x = field.goalLine() - model::kBallRadius;
  const double y = field.touchLine() - model::kBallRadius;
  // Not at the corner of the field, but halfway between it and the post.
  const double corner = 0.5 * (field.touchLine() + field.post()) - model::kBallRadius;
  switch (phase) {
    case Phase::OwnKickIn:
    case Phase::OpponentKickIn:
      return Vector2(std::clamp(p_FB.x(), -x, x), std::copysign(y, p_FB.y()));
    case Phase::OwnCorner:
      return Vector2(x, std::copysign(corner, p_FB.y()));
    case Phase::OpponentCorner:
      return Vector2(-x, std::copysign(corner, p_FB.y()));
    case Phase::OwnGoalKick:
      return Vector2(kGoalKick - field.goalLine(), 0.0);
    case Phase::OpponentGoalKick:
      return Vector2(field.goalLine() - kGoalKick, 0.0);
    case Phase::OwnFreeKick:
    case Phase::OpponentFreeKick:
    case Phase::OwnDirectFreeKick:
    case Phase::OpponentDirectFreeKick:
      return freeKickSpot(p_FB, field);
    default:
      return std::nullopt;
  }
}

}  // namespace nonet::world
