#include <algorithm>
#include <cmath>
#include <optional>

#include "nonet/math/direction.h"
#include "nonet/team/ball_play.h"

namespace nonet::team {

namespace {

constexpr int kPlacesAside = 3;  // in the goal, on either side of the middle

// The ball crosses the line fast, and low enough.
bool reaches(const motion::KickHead& kick, double distance, const ShotParameters& p) {
  return distance >= kick.shortest && distance < p.reach * kick.longest;
}

}  // namespace

std::optional<Shot> bestShot(const world::WorldState& world, std::span<const motion::KickOption> kicks,
                             const ShotParameters& p) {
  const Vector2 ball = world.ball.p_FB.head<2>();
  const Vector2 goal(0.5 * world.field.length, 0.0);
  if ((goal - ball).norm() > p.distance) return std::nullopt;
  const double side = 0.5 * world.field.goalWidth - p.postMargin;
  std::optional<Shot> best;
  double most = 0.0;
  for (int i = -kPlacesAside; i <= kPlacesAside; ++i) {
    const Vector2 place(goal.x(), side * i / kPlacesAside);
    const double hits = hitsGoal(world, directionOf(place - ball), p.spread);
    if (hits < p.hits) continue;
    for (const motion::KickOption& kick : kicks) {
      if (kick.foot != model::Side::Left || !reaches(kick.head, (place - ball).norm(), p)) continue;
      const double lane = laneWidth(world, ball, place, p.widest, kick.head);
      if (lane < p.lane || hits * lane <= most) continue;
      most = hits * lane;
      best = Shot{place, kick.name};
    }
  }
  return best;
}

}  // namespace nonet::team
