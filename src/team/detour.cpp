#include "nonet/team/detour.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <optional>

#include "nonet/math/angle.h"
#include "nonet/math/direction.h"
#include "nonet/math/straight_way.h"

namespace nonet::team {

namespace {

constexpr std::size_t kMostDiscs = 32;
constexpr int kDepth = 3;        // corners of corners
constexpr double kFree = 1e-3;   // m, start and end are so far outside of all discs
constexpr double kNarrow = 0.7;  // share of the radii between two that stand close together
// A way through a disc counts longer by so many m, or by so many of its radii if that is more: around a large
// one it is far.
constexpr double kBlocked = 3.0;
constexpr double kBlockedRadii = 4.0;
// Where the arc is longer, the corner of its two tangents lies far off: then two corners.
constexpr double kLongestArc = 2.0;  // rad

struct Discs {
  std::array<Disc, kMostDiscs> items{};
  std::size_t count = 0;
  std::span<const Disc> all() const { return {items.data(), count}; }
};

// Those that are left when neither start nor end lies in any.
Discs aroundEnds(const Vector2& from, const Vector2& to, std::span<const Disc> discs, double share) {
  assert(discs.size() <= kMostDiscs);
  Discs result;
  for (const Disc& disc : discs) {
    const double nearest = std::min((from - disc.p_F).norm(), (to - disc.p_F).norm());
    const double radius = std::min(share * disc.radius, nearest - kFree);
    if (radius > 0.0) result.items[result.count++] = {disc.p_F, radius};
  }
  return result;
}

// The first disc that the way cuts.
const Disc* firstCut(const Vector2& from, const Vector2& to, std::span<const Disc> discs) {
  const StraightWay way(from, to);
  const Disc* first = nullptr;
  double entry = way.length();
  for (const Disc& disc : discs) {
    const auto [ahead, aside] = way.placeOf(disc.p_F);
    if (ahead <= 0.0 || ahead - disc.radius > entry) continue;
    const double inside = disc.radius * disc.radius - aside * aside;
    if (inside <= 0.0) continue;
    const double enters = ahead - std::sqrt(inside);
    if (enters >= entry) continue;
    entry = enters;
    first = &disc;
  }
  return first;
}

// Where the tangents of both ends meet, with the disc on the right (side 1) or on the left (-1).
Vector2 cornerBeside(const Disc& disc, const Vector2& from, const Vector2& to, double side) {
  const double radius = disc.radius + kFree;
  const auto tangent = [&](const Vector2& end) {
    return std::acos(std::min(radius / std::max((end - disc.p_F).norm(), radius), 1.0));
  };
  // Counted so that the way goes clockwise around the disc on the right.
  const double begin = -side * directionOf(from - disc.p_F) + tangent(from);
  const double end = -side * directionOf(to - disc.p_F) - tangent(to);
  const double arc = std::min(wrapAngle(end - begin - kPi) + kPi, kLongestArc);
  const double middle = -side * (begin + 0.5 * arc);
  return disc.p_F + radius / std::cos(0.5 * arc) * unitVector(middle);
}

struct Search {
  std::span<const Disc> discs;
  Vector2 start;
  Facing facing;

  double turn(const Vector2& from, const Vector2& to) const {
    if (facing.cost == 0.0 || (from - start).squaredNorm() > 0.0) return 0.0;
    return facing.cost * std::abs(angleDifference(directionOf(to - from), facing.direction));
  }

  Detour find(const Vector2& from, const Vector2& to, int depth) const {
    Detour best{to, (to - from).norm() + turn(from, to), true, false};
    const Disc* disc = firstCut(from, to, discs);
    if (disc == nullptr) return best;
    best.blocked = true;
    best.length += std::max(kBlocked, kBlockedRadii * disc->radius);
    if (depth == 0) return best;
    for (const double side : {1.0, -1.0}) {
      const Vector2 corner = cornerBeside(*disc, from, to, side);
      const Detour before = find(from, corner, depth - 1);
      if (before.length >= best.length) continue;
      const Detour after = find(corner, to, depth - 1);
      if (before.length + after.length >= best.length) continue;
      best = {before.next, before.length + after.length, false, before.blocked || after.blocked};
    }
    return best;
  }
};

}  // namespace

Detour detour(const Vector2& from, const Vector2& to, std::span<const Disc> discs, const Facing& facing,
              double squeezeFor) {
  const Discs whole = aroundEnds(from, to, discs, 1.0);
  Detour way = Search{whole.all(), from, facing}.find(from, to, kDepth);
  if (!way.blocked && (way.straight || std::isinf(squeezeFor))) return way;
  const Discs narrow = aroundEnds(from, to, discs, kNarrow);
  Detour squeezed = Search{narrow.all(), from, facing}.find(from, to, kDepth);
  const bool worthIt = !squeezed.blocked && way.length - squeezed.length > squeezeFor;
  if (!way.blocked && !worthIt) return way;
  squeezed.blocked = true;
  return squeezed;
}

}  // namespace nonet::team
