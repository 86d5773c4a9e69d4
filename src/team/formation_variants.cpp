// Other formations than the team's own: what it is compared with, and sparring partners. The tables are
// drawings, not parameters: they say what each variant is.
#include <algorithm>

#include "nonet/team/formation.h"

namespace nonet::team {

namespace {

// The line from the own goal to the ball, and what lies beside it.
struct GoalLine {
  GoalLine(const Vector2& p_FB, const world::FieldGeometry& field)
      : goal(field.ownGoal()),
        distance(std::max((p_FB - goal).norm(), 1e-6)),
        along((p_FB - goal) / distance),
        aside(-along.y(), along.x()) {}

  Vector2 at(double fromGoal, double side) const { return goal + fromGoal * along + side * aside; }

  Vector2 goal;
  double distance;
  Vector2 along;
  Vector2 aside;
};

// One on the ball, one behind it, the others in rows before the own goal.
Places defensePlaces(const Vector2& p_FB, const GoalLine& line, const FormationParameters& parameters) {
  struct Place {
    double fromGoal, side;  // m
  };
  static constexpr std::array<Place, kFieldRoles - 2> kRows = {
      {{3.0, 0.7}, {5.0, -0.7}, {6.0, 2.0}, {6.0, -2.5}, {7.5, 0.0}, {4.5, 3.5}, {4.5, -3.5}, {9.0, 0.0}}};
  // Of the way to the ball: nobody stands beyond it.
  constexpr double kFarthest = 0.85;
  Places places{};
  places[0] = p_FB;
  places[1] = p_FB - parameters.stopperBehind * line.along;
  for (std::size_t i = 0; i < kRows.size(); ++i)
    places[i + 2] = line.at(std::min(kRows[i].fromGoal, kFarthest * line.distance), kRows[i].side);
  return places;
}

// One on the ball, the others in boxes of the field, each as near to the ball as its box lets it halfway.
Places boxPlaces(const Vector2& p_FB, const world::FieldGeometry& field) {
  struct Box {
    int column, row;  // thirds of the field: -1 own or right, 1 the other's or left
  };
  static constexpr std::array<Box, kFieldRoles - 1> kBoxes = {
      {{0, 0}, {-1, 0}, {-1, 1}, {1, 0}, {0, 1}, {0, -1}, {-1, -1}, {1, 1}, {1, -1}}};
  constexpr double kFollow = 0.5;  // of the way to the place in the box that is nearest to the ball
  const Vector2 size(field.length / 3.0, field.width / 3.0);
  Places places{};
  places[0] = p_FB;
  for (std::size_t i = 0; i < kBoxes.size(); ++i) {
    const Vector2 centre = Vector2(kBoxes[i].column, kBoxes[i].row).cwiseProduct(size);
    const Vector2 nearest = p_FB.cwiseMax(centre - 0.5 * size).cwiseMin(centre + 0.5 * size);
    places[i + 1] = centre + kFollow * (nearest - centre);
  }
  return places;
}

// Three at the ball, the others staggered on the line to the own goal.
Places wallPlaces(const Vector2& p_FB, const GoalLine& line) {
  constexpr double kBehind = 0.5;  // m; so near, and not in one pile with the one on the ball
  constexpr double kBeside = 0.8;
  struct Place {
    double share, side;  // of the way from the own goal to the ball; m
  };
  static constexpr std::array<Place, kFieldRoles - 3> kRows = {
      {{0.8, 0.0}, {0.6, 0.7}, {0.5, -0.7}, {0.35, 0.4}, {0.25, -0.4}, {0.7, -1.2}, {0.7, 1.2}}};
  Places places{};
  places[0] = p_FB;
  places[1] = line.at(line.distance - kBehind, kBeside);
  places[2] = line.at(line.distance - kBehind, -kBeside);
  for (std::size_t i = 0; i < kRows.size(); ++i)
    places[i + 3] = line.at(kRows[i].share * line.distance, kRows[i].side);
  return places;
}

}  // namespace

std::optional<Places> variantPlaces(const Vector2& p_FB, const world::FieldGeometry& field,
                                    const FormationParameters& parameters, const VariantParameters& variant) {
  const GoalLine line(p_FB, field);
  if (variant.defense) return defensePlaces(p_FB, line, parameters);
  if (variant.boxes) return boxPlaces(p_FB, field);
  if (variant.wall) return wallPlaces(p_FB, line);
  return std::nullopt;
}

}  // namespace nonet::team
