#include <algorithm>
#include <cmath>
#include <optional>

#include "nonet/team/behaviors.h"

#include "team/behaviors/take_place.h"

namespace nonet::team {

namespace {

// At their goal kick the referee moves everybody of us out of their penalty area, again and again, and most
// fall.
Vector2 outOfTheirArea(const Situation& s, Vector2 place) {
  const double room = s.parameters.clearOfGoalKick;
  const double edge = s.world.field.goalLine() - s.world.field.areaLength - room;
  if (std::abs(place.y()) < 0.5 * s.world.field.areaWidth + room) place.x() = std::min(place.x(), edge);
  return place;
}

}  // namespace

// Everybody keeps the distance that the referee enforces; the one on the ball waits on the own goal's side.
std::optional<Action> opponentSetPiece(const Situation& s) {
  if (!world::isOpponentSetPiece(s.phase())) return std::nullopt;
  constexpr double kAnyDistance = 0.1;  // m; only the direction counts, the place is moved out below
  constexpr double kTieBreak = 1e-3;    // m; towards the own goal for a place on the ball itself
  const Vector2 ball = s.ball();
  const Vector2 ownGoal = s.world.field.ownGoal();
  const bool blocks = s.role == Role::OnBall;
  Vector2 place = blocks ? Vector2(ball + kAnyDistance * (ownGoal - ball).normalized()) : rolePlace(s);
  const Vector2 away = place - ball;
  const double clear = s.clearOfOpponentKick();
  if (away.norm() < clear) place = ball + clear * (away + Vector2(-kTieBreak, 0.0)).normalized();
  if (s.phase() == world::Phase::OpponentGoalKick) place = outOfTheirArea(s, place);
  std::optional<double> heading;
  if (s.phase() == world::Phase::OpponentKickOff) {
    place.x() = std::min(place.x(), -s.parameters.setPlay.kickOffLine);
    // The head alone finds the ball from there, and who then runs ahead need not turn.
    heading = 0.0;
  }
  // Who stands on the circle itself may walk along it.
  constexpr double kOnCircle = 0.1;  // m
  return Action(takePlace(s, place, clear - kOnCircle, heading),
                blocks ? "block the way to the goal" : "place of the role");
}

}  // namespace nonet::team
