#include <algorithm>
#include <cassert>

#include "nonet/team/formation.h"

namespace nonet::team {

namespace {

struct Threats {
  std::array<Vector2, world::kTeamSize> places;  // the most dangerous first
  std::size_t count = 0;
};

Threats threatsOf(const Vector2& p_FB, std::span<const world::PlayerState> opponents,
                  const world::FieldGeometry& field, const FormationParameters& parameters) {
  const Vector2 goal = field.ownGoal();
  Threats threats;
  for (const world::PlayerState& opponent : opponents) {
    const Vector2 place = opponent.X_FP.translation;
    if (!opponent.known || (place - goal).norm() >= parameters.markWithin) continue;
    if ((place - p_FB).norm() < parameters.markFree) continue;
    assert(threats.count < threats.places.size());
    threats.places[threats.count++] = place;
  }
  std::sort(threats.places.begin(), threats.places.begin() + threats.count,
            [&](const Vector2& a, const Vector2& b) {
              return (a - goal).squaredNorm() < (b - goal).squaredNorm();
            });
  return threats;
}

Vector2 guard(const Vector2& threat, const world::FieldGeometry& field,
              const FormationParameters& parameters) {
  const Vector2 way = field.ownGoal() - threat;
  const double step = std::min(parameters.markBehind, way.norm());
  return threat + step * way.stableNormalized();
}

}  // namespace

void markOpponents(Places& places, std::span<const world::PlayerState> opponents,
                   const world::FieldGeometry& field, const FormationParameters& parameters) {
  const Vector2& ball = places[static_cast<std::size_t>(Role::OnBall)];
  if ((ball - field.ownGoal()).norm() >= parameters.markWithin) return;
  const Threats threats = threatsOf(ball, opponents, field, parameters);
  Vector2& left = places[static_cast<std::size_t>(Role::WingLeft)];
  Vector2& right = places[static_cast<std::size_t>(Role::WingRight)];
  if (threats.count == 1) {
    const Vector2 place = guard(threats.places[0], field, parameters);
    ((place - left).squaredNorm() <= (place - right).squaredNorm() ? left : right) = place;
  } else if (threats.count > 1) {
    const auto [leftOne, rightOne] =
        std::minmax(threats.places[0], threats.places[1],
                    [](const Vector2& a, const Vector2& b) { return a.y() > b.y(); });
    left = guard(leftOne, field, parameters);
    right = guard(rightOne, field, parameters);
  }
}

}  // namespace nonet::team
