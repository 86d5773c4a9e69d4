#include "nonet/team/navigation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "nonet/math/direction.h"

namespace nonet::team {

namespace {

// Step of the directions that are compared: fine enough beside the width of a robot.
constexpr double kHeadingStep = toRadians(15);

struct Obstacle {
  Vector2 p_F;
  double room = 0.0;  // m
};

struct Obstacles {
  std::array<Obstacle, 2 * world::kTeamSize + 1> items{};
  std::size_t count = 0;
  std::span<const Obstacle> all() const { return {items.data(), count}; }
};

Obstacles obstaclesFor(const world::WorldState& world, const NavigationParameters& parameters,
                       const Caution& caution) {
  Obstacles obstacles;
  const Vector2 ball = world.ball.p_FB.head<2>();
  const auto add = [&](const world::PlayerState& player, double room) {
    if (!player.known) return;
    if (player.fallen) room += parameters.fallenRoom;
    if (caution.duel && (player.X_FP.translation - ball).norm() < parameters.atBall)
      room = parameters.bodyRoom;
    obstacles.items[obstacles.count++] = {player.X_FP.translation + parameters.lookAhead * player.v_FP, room};
  };
  for (int unum = 1; unum <= world::kTeamSize; ++unum) {
    const auto i = static_cast<std::size_t>(unum);
    if (unum != world.game.unum)
      add(world.teammates[i], unum == caution.onBall ? caution.onBallRoom : caution.robots);
    add(world.opponents[i], caution.robots);
  }
  if (caution.ball > 0.0 && world.ball.known) obstacles.items[obstacles.count++] = {ball, caution.ball};
  return obstacles;
}

// How far one can go in this direction before somebody's room begins; somebody whose room one is in already
// bars the directions that lead nearer.
double freeWay(const Vector2& start, const Vector2& direction, double length, double slip,
               std::span<const Obstacle> obstacles, double share = 1.0) {
  double free = length;
  for (const Obstacle& obstacle : obstacles) {
    const double room = share * obstacle.room;
    const Vector2 offset = obstacle.p_F - start;
    const double ahead = offset.dot(direction);
    const double squared = offset.squaredNorm();
    if (ahead <= 0.0) continue;
    if (squared < room * room) {
      // Along the edge of the room is allowed, so that one can slip past.
      if (ahead > slip * std::sqrt(squared)) free = 0.0;
      continue;
    }
    const double besides = squared - ahead * ahead;
    if (besides >= room * room) continue;
    free = std::min(free, ahead - std::sqrt(room * room - besides));
  }
  return std::max(free, 0.0);
}

// A place in somebody's room cannot be reached: the nearest one to be had instead.
Vector2 outsideOfRooms(Vector2 place, const Vector2& start, std::span<const Obstacle> obstacles) {
  for (const Obstacle& obstacle : obstacles) {
    if ((place - obstacle.p_F).norm() >= obstacle.room) continue;
    const Vector2 towardsUs = start - obstacle.p_F;
    if (towardsUs.norm() > 1e-6) place = obstacle.p_F + obstacle.room * towardsUs.normalized();
  }
  return place;
}

struct Way {
  double heading = 0.0;
  bool straight = true;
  bool anywhere = true;  // false: barred on all sides
};

// The direction nearest to the wanted one that is clear; of two equal ones that which the robot faces more.
Way chooseWay(const world::WorldState& world, const NavigationParameters& parameters,
              const Vector2& p_FTarget, std::span<const Obstacle> obstacles) {
  const Vector2 start = world.self.X_FR.translation;
  const double wanted = headingTo(world, p_FTarget);
  const double need = std::min((p_FTarget - start).norm(), parameters.horizon);
  Way best;
  best.heading = wanted;
  if (freeWay(start, unitVector(wanted), need, parameters.slip, obstacles) >= need - 1e-9) return best;
  best.straight = false;
  double bestScore = -std::numeric_limits<double>::infinity();
  const double facing = angleDifference(world.self.X_FR.rotation, wanted);
  const int count = static_cast<int>(std::lround(kPi / kHeadingStep));
  for (int i = -count; i < count; ++i) {
    const double turn = i * kHeadingStep;
    // Between two that stand close together rather than back out of a trap.
    for (const double share : {1.0, parameters.narrow}) {
      const double free = freeWay(start, unitVector(wanted + turn), std::min(need, parameters.freeWay),
                                  parameters.slip, obstacles, share);
      const double score = free - parameters.turnCost * std::abs(turn) -
                           parameters.facingCost * std::abs(wrapAngle(turn - facing)) -
                           (share < 1.0 ? parameters.narrowCost : 0.0);
      if (free <= parameters.leastWay || score <= bestScore) continue;
      bestScore = score;
      best.heading = wrapAngle(wanted + turn);
    }
  }
  best.anywhere = std::isfinite(bestScore);
  return best;
}

double roomLeft(const Vector2& start, double bodyRoom, std::span<const Obstacle> obstacles) {
  double left = std::numeric_limits<double>::infinity();
  for (const Obstacle& obstacle : obstacles) left = std::min(left, (obstacle.p_F - start).norm() - bodyRoom);
  return left;
}

}  // namespace

double headingTo(const world::WorldState& world, const Vector2& p_F) {
  const Vector2 way = p_F - world.self.X_FR.translation;
  return directionOf(way);
}

motion::MotionRequest walkTo(const world::WorldState& world, const NavigationParameters& parameters,
                             const Pose2& X_FWanted, const Caution& caution) {
  const Vector2 start = world.self.X_FR.translation;
  const Obstacles obstacles = obstaclesFor(world, parameters, caution);
  const Pose2 X_FTarget(outsideOfRooms(X_FWanted.translation, start, obstacles.all()), X_FWanted.rotation);
  const double distance = (X_FTarget.translation - start).norm();
  const bool arrived = distance < parameters.closeEnough;
  const bool crowded = roomLeft(start, parameters.bodyRoom, obstacles.all()) < parameters.crowded;
  const Pose2 X_RF = world.self.X_FR.inverse();
  if (arrived && !crowded) {
    const motion::WalkTo last{X_RF * X_FTarget};
    if (std::abs(last.target.rotation) < parameters.facing) return motion::Stand{};
    return last;
  }
  const Way way = chooseWay(world, parameters, X_FTarget.translation, obstacles.all());
  if (!way.anywhere) return motion::Stand{};
  if (way.straight) {
    const double heading = distance > parameters.headingDistance ? way.heading : X_FTarget.rotation;
    return motion::WalkTo{X_RF * Pose2(X_FTarget.translation, heading)};
  }
  // Around somebody: a step at a time, slowly where it is narrow. Giving way to somebody close needs no turn.
  const double step = crowded ? parameters.slowStep : parameters.detourStep;
  const Vector2 next = start + step * unitVector(way.heading);
  const double heading = crowded ? world.self.X_FR.rotation : way.heading;
  return motion::WalkTo{X_RF * Pose2(next, heading), crowded};
}

}  // namespace nonet::team
