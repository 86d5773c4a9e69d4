// Ways around discs against the closed form for one disc, and against the shortest path over many points
// around several.
#include "nonet/team/detour.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "nonet/math/angle.h"
#include "nonet/math/direction.h"
#include "nonet/math/random.h"

namespace nonet::team {
namespace {

double distanceFrom(const Vector2& place, const Vector2& from, const Vector2& to) {
  const Vector2 way = to - from;
  const double share = std::clamp((place - from).dot(way) / std::max(way.squaredNorm(), 1e-12), 0.0, 1.0);
  return (place - from - share * way).norm();
}

bool clear(const Vector2& from, const Vector2& to, const std::vector<Disc>& discs, double slack = 1e-6) {
  return std::all_of(discs.begin(), discs.end(), [&](const Disc& disc) {
    return distanceFrom(disc.p_F, from, to) >= disc.radius - slack;
  });
}

// Dijkstra over points just outside of the discs.
double shortestPath(const Vector2& from, const Vector2& to, const std::vector<Disc>& discs) {
  constexpr int kPoints = 48;
  std::vector<Vector2> places = {from, to};
  for (const Disc& disc : discs)
    for (int i = 0; i < kPoints; ++i)
      places.push_back(disc.p_F +
                       disc.radius / std::cos(kPi / kPoints) * unitVector(2.0 * kPi * i / kPoints));
  std::vector<double> length(places.size(), std::numeric_limits<double>::infinity());
  std::vector<bool> done(places.size());
  length[0] = 0.0;
  for (std::size_t round = 0; round < places.size(); ++round) {
    std::size_t nearest = places.size();
    for (std::size_t i = 0; i < places.size(); ++i)
      if (!done[i] && (nearest == places.size() || length[i] < length[nearest])) nearest = i;
    if (nearest == 1 || std::isinf(length[nearest])) break;
    done[nearest] = true;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const double longer = length[nearest] + (places[i] - places[nearest]).norm();
      if (longer < length[i] && clear(places[nearest], places[i], discs)) length[i] = longer;
    }
  }
  return length[1];
}

struct Walked {
  double length = 0.0;
  bool arrived = false;
  bool touched = false;
  bool squeezed = false;  // into three tenths of somebody's radius
  bool told = false;      // that the way is blocked
};

// From corner to corner, asking anew at each.
Walked walk(Vector2 place, const Vector2& to, const std::vector<Disc>& discs) {
  Walked walked;
  std::vector<Disc> narrow = discs;
  for (Disc& disc : narrow) disc.radius *= 0.7;
  for (int leg = 0; leg < 20 && !walked.arrived; ++leg) {
    const Detour way = detour(place, to, discs);
    walked.touched |= !clear(place, way.next, discs, 1e-3);
    walked.squeezed |= !clear(place, way.next, narrow, 1e-3);
    walked.told |= way.blocked;
    walked.length += (way.next - place).norm();
    walked.arrived = way.straight;
    place = way.next;
  }
  return walked;
}

TEST(Detour, IsStraightWhereNobodyStands) {
  const std::vector<Disc> discs = {{{2.0, 1.0}, 0.7}, {{-1.0, 0.0}, 0.9}};
  const Detour way = detour({0.0, 0.0}, {5.0, 0.0}, discs);
  EXPECT_TRUE(way.straight);
  EXPECT_FALSE(way.blocked);
  EXPECT_EQ(way.next, Vector2(5.0, 0.0));
  EXPECT_DOUBLE_EQ(way.length, 5.0);
}

TEST(Detour, AroundOneDiscTakesTangentsOnTheNearSide) {
  Random random(3);
  for (int trial = 0; trial < 300; ++trial) {
    const double radius = random.uniform(0.3, 1.0);
    const double aside = random.uniform(-0.95, 0.95) * radius;
    const double ahead = random.uniform(1.1, 3.0) * radius;
    const double beyond = random.uniform(1.1, 3.0) * radius;
    const std::vector<Disc> discs = {{{ahead, aside}, radius}};
    const Vector2 to(ahead + beyond, 0.0);
    const Detour way = detour({0.0, 0.0}, to, discs);
    ASSERT_FALSE(way.straight);
    ASSERT_FALSE(way.blocked);
    EXPECT_LT(way.next.y() * aside, 0.0) << "the shorter side";
    // The taut string: two tangents and the arc between them.
    const double a = discs[0].p_F.norm();
    const double b = (to - discs[0].p_F).norm();
    const double between =
        std::abs(angleDifference(directionOf(-discs[0].p_F), directionOf(to - discs[0].p_F)));
    const double arc = between - std::acos(radius / a) - std::acos(radius / b);
    const double string =
        std::sqrt(a * a - radius * radius) + std::sqrt(b * b - radius * radius) + radius * arc;
    EXPECT_GE(way.length, string - 1e-9);
    // One corner instead of an arc.
    EXPECT_LE(way.length, string + radius * (2.0 * std::tan(0.5 * arc) - arc) + 0.01) << arc;
  }
}

TEST(Detour, IsHardlyLongerThanTheShortestPathAroundSeveral) {
  Random random(4);
  int longer = 0;
  int squeezed = 0;
  int lost = 0;
  const int trials = 300;
  for (int trial = 0; trial < trials; ++trial) {
    std::vector<Disc> discs;
    const Vector2 from(-4.0, random.uniform(-1.0, 1.0));
    const Vector2 to(4.0, random.uniform(-1.0, 1.0));
    while (discs.size() < 6) {
      const Vector2 place(random.uniform(-3.0, 3.0), random.uniform(-1.5, 1.5));
      discs.push_back({place, random.uniform(0.3, 0.8)});
    }
    const double shortest = shortestPath(from, to, discs);
    if (std::isinf(shortest)) continue;
    const Walked walked = walk(from, to, discs);
    lost += walked.arrived ? 0 : 1;
    squeezed += walked.squeezed ? 1 : 0;
    EXPECT_LE(walked.touched, walked.told) << "it knows";
    longer += walked.length > 1.15 * shortest ? 1 : 0;
  }
  EXPECT_EQ(lost, 0);
  EXPECT_LE(squeezed, trials / 50);
  EXPECT_LE(longer, trials / 20);
}

TEST(Detour, LeavesDiscsThatHoldItsEnds) {
  const std::vector<Disc> discs = {{{0.2, 0.1}, 0.7}, {{5.0, 0.1}, 0.7}};
  // Away from the middle of the one, up to the place in the other.
  const Detour out = detour({0.0, 0.0}, {-3.0, 0.0}, discs);
  EXPECT_TRUE(out.straight);
  const Vector2 to(4.8, 0.0);
  Vector2 place(0.0, 0.0);
  double nearest = 10.0;
  for (int leg = 0; leg < 10 && place != to; ++leg) {
    const Vector2 next = detour(place, to, discs).next;
    nearest = std::min(nearest, distanceFrom(discs[0].p_F, place, next));
    place = next;
  }
  EXPECT_EQ(place, to);
  EXPECT_GT(nearest, Vector2(0.2, 0.1).norm() - 0.01) << "no nearer than at the start";
}

TEST(Detour, TurnsToTheSideThatOneFaces) {
  const std::vector<Disc> discs = {{{1.5, 0.03}, 0.7}};
  const Vector2 to(3.0, 0.0);
  EXPECT_LT(detour({0.0, 0.0}, to, discs, {0.5, 0.0}).next.y(), 0.0) << "the shorter one";
  EXPECT_GT(detour({0.0, 0.0}, to, discs, {0.5, 0.3}).next.y(), 0.0) << "the one ahead";
  EXPECT_LT(detour({0.0, 0.0}, to, discs, {-0.5, 0.3}).next.y(), 0.0);
}

// A gap between two, or the way around one of them.
TEST(Detour, SqueezesThroughWhereThatIsMuchShorter) {
  const std::vector<Disc> discs = {{{2.0, -0.6}, 0.7}, {{2.0, 0.6}, 0.7}};
  const Vector2 to(4.0, 0.0);
  const Detour around = detour({0.0, 0.0}, to, discs);
  ASSERT_FALSE(around.straight);
  ASSERT_FALSE(around.blocked);
  const Detour between = detour({0.0, 0.0}, to, discs, {}, 0.4);
  EXPECT_TRUE(between.straight);
  EXPECT_TRUE(between.blocked);
  const Detour notFor = detour({0.0, 0.0}, to, discs, {}, around.length - between.length + 0.01);
  EXPECT_EQ(notFor.next, around.next);
}

}  // namespace
}  // namespace nonet::team
