#include "nonet/team/charging.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "nonet/math/angle.h"
#include "nonet/math/direction.h"
#include "nonet/team/own_area.h"

namespace nonet::team {

namespace {

// Of the way's heading while one goes slowly; no play depends on it.
constexpr double kTurnGain = 2.0;   // 1/s
constexpr double kTurnSpeed = 1.0;  // rad/s
constexpr double kStopGain = 1.9;   // 1/s, slower still where it is to stop

double angleBetween(const Vector2& a, const Vector2& b) {
  return std::abs(angleDifference(directionOf(a), directionOf(b)));
}

// The referee would call it if we ran into the opponent that is `toOpponent` away on this way (a unit vector;
// both in the own field frame).
bool wouldCharge(const Situation& s, const Vector2& toOpponent, const Vector2& way) {
  const ChargingParameters& p = s.parameters.charging;
  const Vector2 toBall = s.ball() - s.world.self.X_FR.translation;
  if (toOpponent.norm() > p.reach || way.dot(toOpponent.normalized()) < p.closing) return false;
  const double passes = std::abs(way.x() * toOpponent.y() - way.y() * toOpponent.x());
  if (passes > p.aside) return false;
  if (toBall.norm() < p.touched) return false;
  const double theirs = (toBall - toOpponent).norm();
  const double besideBall = angleBetween(way, toBall);
  const bool runsAtThem = besideBall >= toRadians(30.0) && besideBall >= angleBetween(way, toOpponent);
  return runsAtThem || toBall.norm() > theirs + p.lead;
}

// Far from the ball, where any contact is a foul: it may be nearer than is believed, and what counts is how
// the body moves as well as where it wants to go.
bool wouldBump(const Situation& s, const Vector2& toOpponent, double sigma, const Vector2& way) {
  constexpr double kMostUncertain = 0.4;  // m
  const ChargingParameters& p = s.parameters.charging;
  const double gap = toOpponent.norm() - std::min(2.0 * sigma, kMostUncertain);
  const Vector2 toBall = s.ball() - s.world.self.X_FR.translation;
  if (gap > p.offBallReach || std::min(toBall.norm(), (toBall - toOpponent).norm()) < p.offBall) return false;
  const Vector2& moves = s.world.teammates[static_cast<std::size_t>(s.world.game.unum)].v_FP;
  return way.dot(toOpponent) > 0.0 || moves.dot(toOpponent) > 0.0;
}

// At which one comes to an opponent that is so far without being faster at the contact than `p.speed`, m/s.
double speedBefore(const ChargingParameters& p, double distance) {
  constexpr double kContact = 0.38;  // m between two torsos: navigation.bodyRoom and a margin
  return std::sqrt(p.speed * p.speed + 2.0 * p.brake * std::max(0.0, distance - kContact));
}

// m/s, on this way (own field frame, a unit vector); infinite: as fast as it can.
double allowedSpeed(const Situation& s, const Vector2& way) {
  const ChargingParameters& p = s.parameters.charging;
  double speed = std::numeric_limits<double>::infinity();
  for (const world::PlayerState& player : s.world.opponents) {
    if (!player.known || player.fallen) continue;
    const Vector2 toOpponent = player.X_FP.translation - s.world.self.X_FR.translation;
    if (wouldCharge(s, toOpponent, way)) speed = std::min(speed, speedBefore(p, toOpponent.norm()));
    if (wouldBump(s, toOpponent, player.sigma, way)) speed = std::min(speed, p.offBallSpeed);
  }
  return speed;
}

}  // namespace

std::optional<motion::MotionRequest> spareOpponents(const Situation& s,
                                                    const motion::MotionRequest& request) {
  const auto* walk = std::get_if<motion::WalkTo>(&request);
  // In its own area the goalie is let go.
  const bool immune = s.role == Role::Goalie && inOwnArea(s.world.field, s.world.self.X_FR.translation);
  if (walk == nullptr || s.parameters.charging.speed == 0.0 || !s.acts() || immune) return std::nullopt;
  const Vector2 step = walk->target.translation;
  if (step.norm() < 1e-3) return std::nullopt;
  const Vector2 way = s.world.self.X_FR.rotate(step).normalized();
  const double speed = allowedSpeed(s, way);
  if (std::isinf(speed)) return std::nullopt;
  const double slow = walk->stopAtTarget ? std::min(speed, kStopGain * step.norm()) : speed;
  const double turn = std::clamp(kTurnGain * walk->target.rotation, -kTurnSpeed, kTurnSpeed);
  return motion::WalkVelocity{Pose2(slow * step.normalized(), turn)};
}

}  // namespace nonet::team
