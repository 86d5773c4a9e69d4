#include <algorithm>
#include <optional>
#include <utility>

#include "nonet/math/direction.h"
#include "nonet/team/ball_choice.h"
#include "nonet/team/ball_play.h"
#include "nonet/team/play_time.h"

namespace nonet::team {

namespace {

constexpr int kPlacesAside = 3;  // in the goal, on either side of the middle

// The probability that the ball crosses the line fast, between the posts and below the bar.
double scores(const world::WorldState& world, const motion::KickHead& kick, const Vector2& way,
              const ShotParameters& p) {
  const double distance = way.norm();
  if (distance >= (kick.scales ? p.low : p.reach * kick.longest)) return 0.0;
  return hitsGoal(world, directionOf(way), p.spread) * kick.fliesBelow(world.field.goalHeight, distance);
}

}  // namespace

std::optional<Shot> bestShot(const world::WorldState& world, std::span<const motion::KickOption> kicks,
                             const ShotParameters& p, const std::optional<double>& present) {
  const Vector2 ball = world.ball.p_FB.head<2>();
  const Vector2 goal = world.field.theirGoal();
  if ((goal - ball).norm() > p.distance) return std::nullopt;
  const double side = world.field.post() - p.postMargin;
  const double nearest = nearestOf(world.opponents, ball);
  std::optional<Shot> best;
  std::pair<bool, double> most{false, 0.0};
  for (int i = -kPlacesAside; i <= kPlacesAside; ++i) {
    const Vector2 place(goal.x(), side * i / kPlacesAside);
    if (mateBars(world, ball, place)) continue;
    const double share = isSameKick(present, directionOf(place - ball)) ? p.keep : 1.0;
    for (const motion::KickOption& kick : kicks) {
      if (kick.foot != model::Side::Left || !kick.head.isStraight() || !kick.head.hasRoom(nearest)) continue;
      const double hits = scores(world, kick.head, place - ball, p);
      if (hits < share * p.hits) continue;
      const double lane = laneWidth(world, ball, place, p.widest, kick.head);
      // A chip, which is slower and goes less far, and a kick that takes more time to be exact, only where no
      // other kick serves.
      const std::pair rated{!kick.head.onlyByName(), hits * lane};
      if (lane < share * p.lane || rated <= most) continue;
      most = rated;
      // A kick that goes as far as it is asked to is asked for all.
      const Vector2 asked = ball + kick.head.longest * (place - ball).normalized();
      best = Shot{kick.head.scales ? asked : place, kick.name};
    }
  }
  return best;
}

}  // namespace nonet::team
