#include "nonet/team/own_area.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace nonet::team {

namespace {

constexpr double kAtCorner = 1e-3;     // m
constexpr double kBeyondCorner = 0.5;  // m: nobody stops at a corner

// The area with its margin: everything behind x = front between y = -side and side. The goal line is no edge,
// since nobody walks around behind the goal.
struct Area {
  double front = 0.0;
  double side = 0.0;

  bool holds(const Vector2& p) const { return p.x() < front && std::abs(p.y()) < side; }

  Vector2 nearestEdge(const Vector2& p) const {
    if (front - p.x() < side - std::abs(p.y())) return {front, p.y()};
    return {p.x(), std::copysign(side, p.y())};
  }

  // Whether the straight way from a to b leads through the inside; along an edge is clear.
  bool bars(const Vector2& a, const Vector2& b) const {
    constexpr double kAlong = 1e-6;
    double from = 0.0;
    double to = 1.0;
    const Vector2 way = b - a;
    const auto clip = [&](double slope, double room) {  // keeps the part where slope * t < room
      if (std::abs(slope) < kAlong) {
        if (room <= kAlong) to = from;
      } else if (slope > 0.0) {
        to = std::min(to, room / slope);
      } else {
        from = std::max(from, room / slope);
      }
    };
    clip(way.x(), front - a.x());
    clip(way.y(), side - a.y());
    clip(-way.y(), side + a.y());
    return to - from > kAlong;
  }
};

Area areaWith(const world::FieldGeometry& field, double margin) {
  return {-field.goalLine() + field.areaLength + margin, 0.5 * field.areaWidth + margin};
}

}  // namespace

bool inOwnArea(const world::FieldGeometry& field, const Vector2& p_F, double margin) {
  return areaWith(field, margin).holds(p_F);
}

int matesInOwnArea(const world::WorldState& world) {
  int count = 0;
  for (int unum = 1; unum <= world::kTeamSize; ++unum) {
    const world::PlayerState& mate = world.teammates[static_cast<std::size_t>(unum)];
    if (unum != world.game.unum && mate.known && inOwnArea(world.field, mate.X_FP.translation)) ++count;
  }
  return count;
}

Vector2 aroundOwnArea(const world::FieldGeometry& field, const Vector2& p_FStart, Vector2 p_FTarget,
                      double margin) {
  const Area area = areaWith(field, margin);
  if (area.holds(p_FTarget)) p_FTarget = area.nearestEdge(p_FTarget);
  if (inOwnArea(field, p_FStart)) return p_FTarget;
  const Vector2 start = area.holds(p_FStart) ? area.nearestEdge(p_FStart) : p_FStart;
  if (!area.bars(start, p_FTarget)) return p_FTarget;
  // Around one corner, or along the front from one to the other.
  Vector2 next = p_FTarget;
  double shortest = std::numeric_limits<double>::infinity();
  for (const double side : {area.side, -area.side}) {
    const Vector2 first(area.front, side);
    const Vector2 second(area.front, -side);
    if (area.bars(start, first)) continue;
    const double to = (first - start).norm();
    const bool last = !area.bars(first, p_FTarget);
    const double onward = last ? (p_FTarget - first).norm() : 2.0 * area.side + (p_FTarget - second).norm();
    if (to + onward >= shortest) continue;
    shortest = to + onward;
    next = to > kAtCorner ? first : last ? p_FTarget : second;
  }
  if (next == p_FTarget) return next;
  return next + kBeyondCorner * (next - start).normalized();
}

}  // namespace nonet::team
