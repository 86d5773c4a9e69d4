#include "nonet/team/way_behind.h"

#include <algorithm>
#include <cmath>

#include "nonet/math/angle.h"

namespace nonet::team {

namespace {

// Corners are cut by so much, so that the next point is a step ahead and does not jump about.
constexpr double kCut = 0.03;  // m
constexpr int kHalvings = 8;   // to less than a degree
constexpr int kArcPieces = 12;

// Mirrored to the side with positive y.
Vector2 onCurve(const BallCurve& curve, double angle) {
  return curve.radius(angle) * Vector2(-std::cos(angle), std::sin(angle));
}

double angleOf(const Vector2& place) {
  return std::atan2(place.y(), -place.x());
}

Vector2 nearestToBall(const Vector2& from, const Vector2& to) {
  const Vector2 way = to - from;
  const double share = std::clamp(-from.dot(way) / std::max(way.squaredNorm(), 1e-12), 0.0, 1.0);
  return from + share * way;
}

bool straightTo(const Vector2& from, double angle, const BallCurve& curve) {
  const Vector2 nearest = nearestToBall(from, onCurve(curve, angle));
  return nearest.norm() >= std::min(curve.radius(angleOf(nearest)), from.norm()) - kCut;
}

double lengthOfArc(const BallCurve& curve, double angle) {
  double length = 0.0;
  Vector2 last = onCurve(curve, 0.0);
  for (int i = 1; i <= kArcPieces; ++i) {
    const Vector2 next = onCurve(curve, angle * i / kArcPieces);
    length += (next - last).norm();
    last = next;
  }
  return length;
}

}  // namespace

double BallCurve::radius(double angle) const {
  const double share = std::min(std::abs(angle) / std::max(open, 1e-6), 1.0);
  return behind + share * std::max(beside - behind, 0.0);
}

WayBehind wayBehind(const Vector2& from, const BallCurve& curve, double side) {
  const Vector2 start(from.x(), side >= 0.0 ? from.y() : -from.y());
  const double own = angleOf(start);
  double hidden = 0.0;
  double seen = own >= 0.0 ? own : own + 2.0 * kPi;
  if (straightTo(start, 0.0, curve)) seen = 0.0;
  for (int i = 0; i < kHalvings && seen > 0.0; ++i) {
    const double middle = 0.5 * (hidden + seen);
    (straightTo(start, middle, curve) ? seen : hidden) = middle;
  }
  Vector2 next = onCurve(curve, seen);
  const double length = (next - start).norm() + lengthOfArc(curve, seen);
  if (side < 0.0) next.y() = -next.y();
  return {next, length, seen == 0.0};
}

}  // namespace nonet::team
