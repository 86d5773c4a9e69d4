// The way around the ball against the shortest path over a fine grid of points, and against its bound.
#include "nonet/team/way_behind.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "nonet/math/angle.h"
#include "nonet/math/direction.h"
#include "nonet/math/random.h"

namespace nonet::team {
namespace {

constexpr double kCut = 0.03;  // m, by which corners may be cut

double angleFromBehind(const Vector2& place) {
  return std::abs(std::atan2(place.y(), -place.x()));
}

// Nothing between these two lies within the curve, but for `cut`.
bool clear(const Vector2& from, const Vector2& to, const BallCurve& curve, double cut) {
  for (int i = 0; i <= 60; ++i) {
    const Vector2 place = from + (i / 60.0) * (to - from);
    if (place.norm() < curve.radius(angleFromBehind(place)) - cut) return false;
  }
  return true;
}

// The shortest way over points on the curve, each pair of which is joined where nothing is in between.
double shortestWay(const Vector2& from, const BallCurve& curve, double side) {
  const double start = std::atan2(side * from.y(), -from.x());
  const double whole = start >= 0.0 ? start : start + 2.0 * kPi;
  const int pieces = 120;
  std::vector<Vector2> places;
  for (int i = 0; i <= pieces; ++i) {
    const double angle = whole * i / pieces;
    places.push_back((curve.radius(std::min(angle, 2.0 * kPi - angle)) + 1e-4) *
                     Vector2(-std::cos(angle), side * std::sin(angle)));
  }
  places.push_back(from);
  std::vector<double> length(places.size(), 1e9);
  length[0] = 0.0;
  for (std::size_t i = 1; i < places.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double way = length[j] + (places[i] - places[j]).norm();
      if (way < length[i] && clear(places[i], places[j], curve, 2e-3)) length[i] = way;
    }
  }
  return length.back();
}

TEST(WayBehind, IsAsLongAsTheShortestWayOfAGraph) {
  Random random(3);
  const BallCurve curve;
  for (int trial = 0; trial < 60; ++trial) {
    const Vector2 from = random.uniform(0.4, 3.0) * unitVector(random.uniform(-kPi, kPi));
    const double side = from.y() >= 0.0 ? 1.0 : -1.0;
    const double found = wayBehind(from, curve, side).length;
    const double shortest = shortestWay(from, curve, side);
    // Each corner that is cut by 3 cm makes the way shorter, never longer.
    EXPECT_LE(found, shortest + 0.02) << from.transpose();
    EXPECT_GE(found, shortest - 0.1) << from.transpose();
  }
}

// No step comes nearer than the place, or where the robot is already, but for the cut.
TEST(WayBehind, LeadsToThePlace) {
  Random random(4);
  const BallCurve curve{0.2, 0.32, 1.3};
  for (int trial = 0; trial < 500; ++trial) {
    Vector2 place = random.uniform(0.35, 2.0) * unitVector(random.uniform(-kPi, kPi));
    const double side = random.uniform() < 0.5 ? 1.0 : -1.0;
    const double whole = wayBehind(place, curve, side).length;
    double gone = 0.0;
    while ((place - Vector2(-curve.behind, 0.0)).norm() > 0.02 && gone < 6.0) {
      const double inside = std::min(place.norm(), curve.behind);
      const Vector2 way = wayBehind(place, curve, side).next - place;
      const double step = std::min(0.01, way.norm());
      place += step * way.normalized();
      gone += step;
      EXPECT_GE(place.norm(), inside - kCut) << place.transpose();
    }
    EXPECT_LE(gone, whole + 0.03) << "cut corners make it shorter, never longer";
  }
}

TEST(WayBehind, ComesNoNearerFromInside) {
  const BallCurve curve;
  for (double angle = 0.3; angle < kPi; angle += 0.2) {
    const Vector2 from = 0.15 * Vector2(-std::cos(angle), std::sin(angle));
    const Vector2 next = wayBehind(from, curve, 1.0).next;
    for (int i = 0; i <= 20; ++i) EXPECT_GE((from + i / 20.0 * (next - from)).norm(), 0.15 - kCut) << angle;
  }
}

TEST(WayBehind, GoesOverTheSideThatIsAskedFor) {
  const BallCurve curve;
  const Vector2 ahead(1.0, 0.05);
  EXPECT_GT(wayBehind(ahead, curve, 1.0).next.y(), 0.1);
  EXPECT_LT(wayBehind(ahead, curve, -1.0).next.y(), -0.1);
  EXPECT_LT(wayBehind(ahead, curve, 1.0).length, wayBehind(ahead, curve, -1.0).length);
  const WayBehind straight = wayBehind({-1.0, 0.3}, curve, 1.0);
  EXPECT_TRUE(straight.straight);
  EXPECT_NEAR(straight.length, std::hypot(1.0 - curve.behind, 0.3), 1e-12);
}

}  // namespace
}  // namespace nonet::team
