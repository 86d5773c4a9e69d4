#include "nonet/team/formation.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "nonet/math/direction.h"
#include "nonet/team/own_area.h"
#include "nonet/team/set_play.h"

namespace nonet::team {

namespace {

// At the own kick-off.
constexpr int kReceiver = 6;
constexpr int kTaker = 7;

// What a place must keep: distance from the more important places, nobody but the nearer back with the goalie
// in the own penalty area (illegal defence, server facts 4.10), backs on the own side of the ball.
struct PlaceRules {
  const Formation& formation;
  const world::FieldGeometry& field;
  const FormationParameters& parameters;
  bool backsBehindBall = true;

  bool allows(int index, const Vector2& place) const {
    const Role role = static_cast<Role>(index);
    const bool back = role == Role::BackLeft || role == Role::BackRight;
    if (role != Role::BackLeft && inOwnArea(field, place, parameters.areaMargin)) return false;
    const bool atOwnGoal = role == Role::BackRight && inOwnArea(field, formation.positions[0]);
    if (backsBehindBall && back && !atOwnGoal && beyondBall(place)) return false;
    for (int j = 0; j < index; ++j)
      if ((place - formation.positions[j]).norm() < parameters.apart) return false;
    return true;
  }

  bool beyondBall(const Vector2& place) const {
    const Vector2 ownGoal = field.ownGoal();
    const Vector2 way = formation.positions[0] - ownGoal;
    return (place - ownGoal).dot(way) >= way.squaredNorm();
  }
};

// Near the lines and the own goal places come together: the less important one takes the nearest place that
// is free.
void spread(Formation& formation, const world::FieldGeometry& field, const FormationParameters& parameters,
            bool backsBehindBall) {
  // A grid that is fine enough; no play depends on its step.
  constexpr double kRing = 0.25;  // m
  constexpr int kRings = 20;
  constexpr int kDirections = 16;
  const PlaceRules rules{formation, field, parameters, backsBehindBall};
  for (int i = 1; i < formation.count; ++i) {  // the one on the ball follows it to the line
    const Vector2 wanted = field.nearestInside(formation.positions[i], parameters.touchLineMargin);
    formation.positions[i] = wanted;
    bool found = rules.allows(i, wanted);
    for (int k = 0; k < kRings * kDirections && !found; ++k) {
      const double angle = 2.0 * kPi * (k % kDirections) / kDirections;
      const double radius = kRing * (1 + k / kDirections);  // NOLINT(bugprone-integer-division): ring number
      const Vector2 place =
          field.nearestInside(wanted + radius * unitVector(angle), parameters.touchLineMargin);
      found = rules.allows(i, place);
      if (found) formation.positions[i] = place;
    }
  }
}

// How far from the own goal the nearer back stands: forward as far as no opponent is left behind it. While
// nobody knows where they are it stays at home.
double lineFromGoal(double home, double ballFromGoal, std::span<const world::PlayerState> opponents,
                    const world::FieldGeometry& field, const FormationParameters& parameters) {
  double foremost = std::numeric_limits<double>::infinity();
  for (const world::PlayerState& opponent : opponents)
    if (opponent.known) foremost = std::min(foremost, (opponent.X_FP.translation - field.ownGoal()).norm());
  if (std::isinf(foremost)) return home;
  return std::max(
      home, std::min(ballFromGoal - parameters.lineBehindBall, foremost - parameters.lineBehindOpponent));
}

Places usualPlaces(const Vector2& p_FB, std::span<const world::PlayerState> opponents,
                   const world::FieldGeometry& field, const FormationParameters& parameters) {
  const Vector2 ownGoal = field.ownGoal();
  const Vector2 goalToBall = p_FB - ownGoal;
  const double distance = std::max(goalToBall.norm(), 1e-6);
  const Vector2 along = goalToBall / distance;
  const Vector2 aside(-along.y(), along.x());
  // The backs never stand beyond the ball.
  const double nearBack = std::min(parameters.firstBackFromGoal, 0.5 * distance);
  const double farBack = std::min(parameters.secondBackFromGoal, 0.75 * distance);

  const double line = lineFromGoal(nearBack, distance, opponents, field, parameters);
  const bool joins = distance > parameters.joinFrom;
  const Vector2 fartherBack = joins ? Vector2(p_FB - parameters.joinBehind * along)
                                    : Vector2(ownGoal + farBack * along - parameters.backAside * aside);

  return {
      p_FB,
      p_FB - parameters.stopperBehind * along,
      ownGoal + line * along + parameters.backAside * aside,
      fartherBack,
      p_FB + Vector2(-parameters.wingBehind, parameters.wingAside),
      p_FB + Vector2(-parameters.wingBehind, -parameters.wingAside),
      p_FB + Vector2(parameters.forwardAhead, parameters.forwardAside),
      p_FB + Vector2(parameters.forwardAhead, -parameters.forwardAside),
      p_FB - parameters.supporterBehind * along,
      ownGoal + 0.5 * (nearBack + farBack) * along,
  };
}

}  // namespace

std::string_view roleName(Role role) {
  constexpr std::array<std::string_view, 11> kNames = {
      "on ball",      "stopper",       "back left", "back right", "wing left", "wing right",
      "forward left", "forward right", "supporter", "sweeper",    "goalie"};
  return kNames.at(static_cast<std::size_t>(role));
}

Formation formationFor(const Vector2& p_FB, int count, const world::FieldGeometry& field,
                       const FormationParameters& parameters, const VariantParameters& variant,
                       std::span<const world::PlayerState> opponents,
                       const std::optional<Vector2>& p_FReceiver) {
  assert(count >= 0 && count <= kFieldRoles);
  std::optional<Places> wanted = variantPlaces(p_FB, field, parameters, variant);
  const bool usual = !wanted;
  if (usual) {
    wanted = usualPlaces(p_FB, opponents, field, parameters);
    markOpponents(*wanted, opponents, field, parameters);
  }
  constexpr auto kStopper = static_cast<std::size_t>(Role::Stopper);
  if (p_FReceiver) (*wanted)[kStopper] = *p_FReceiver;
  Formation formation;
  formation.count = count;
  std::copy_n(wanted->begin(), count, formation.positions.begin());
  spread(formation, field, parameters, usual);
  if (p_FReceiver) formation.positions[kStopper] = *p_FReceiver;  // even at the touch line
  return formation;
}

// A table, not parameters: eleven places that are read as a drawing.
Pose2 kickOffPose(int unum, bool ownKickOff, const world::FieldGeometry& field,
                  const SetPlayParameters& parameters) {
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
      {-1.7, -2.7, -2.6, 1.0},  // receiver of the own kick-off: see below
      {-0.35, 0.5, -2.6, 3.2},  // takes the kick-off
      {-0.6, 5.0, -2.6, -1.0},  // forwards
      {-0.6, -5.5, -2.6, -3.2},
      {-6.0, 0.0, -6.0, 0.0},
      {-11.0, 0.0, -11.0, 0.0},
  }};
  const Place& place = places[std::clamp(unum, 1, world::kTeamSize) - 1];
  const double scaleX = field.length / 30.0;
  const double scaleY = field.width / 20.0;
  // Distances to the ball and the circle are the same on every field.
  const double x = ownKickOff ? place.ownX : place.otherX;
  const double y = ownKickOff ? place.ownY : place.otherY;
  const bool atBall = std::abs(x) < field.circleRadius && std::abs(y) < field.circleRadius;
  if (ownKickOff && unum == kReceiver)
    return {setPlayFor(world::Phase::OwnKickOff, Vector2::Zero(), field, parameters).p_FReceiver, 0.0};
  const bool taker = ownKickOff && unum == kTaker;
  return {x < -3.0 ? x * scaleX : x, atBall ? y : y * scaleY, taker ? parameters.kickOffAngle : 0.0};
}

Formation kickOffFormation(const Vector2& p_FB, const world::FieldGeometry& field,
                           const SetPlayParameters& parameters) {
  // The numbers that the roles fall to when nobody is missing, with seven a side and more.
  constexpr std::array<int, kFieldRoles> kNumbers = {kTaker, kReceiver, 2, 3, 4, 5, 8, 9, 10, 11};
  Formation formation;
  formation.count = kFieldRoles;
  formation.positions[0] = p_FB;
  for (std::size_t i = 1; i < kNumbers.size(); ++i)
    formation.positions[i] = kickOffPose(kNumbers[i], true, field, parameters).translation;
  return formation;
}

}  // namespace nonet::team
