#include "nonet/team/navigation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "nonet/math/direction.h"
#include "nonet/team/detour.h"

namespace nonet::team {

namespace {

constexpr std::size_t kPosts = 4;
constexpr double kSomewhere = 1.5;  // m, standard deviation of a place that says nothing

struct Obstacles {
  std::array<Disc, 2 * world::kTeamSize + 2 + kPosts> items{};
  std::size_t count = 0;
  void add(const Vector2& p_F, double room) { items[count++] = {p_F, room}; }
  std::span<const Disc> all() const { return {items.data(), count}; }
};

void addPosts(Obstacles& obstacles, const world::FieldGeometry& field, double room) {
  for (const double x : {-field.goalLine(), field.goalLine()})
    for (const double y : {-field.post(), field.post()}) obstacles.add({x, y}, room);
}

Obstacles obstaclesFor(const world::WorldState& world, const NavigationParameters& parameters,
                       const Caution& caution) {
  Obstacles obstacles;
  const Vector2 ball = world.ball.p_FB.head<2>();
  const auto add = [&](const world::PlayerState& player, double room) {
    if (!player.known) return;
    if (player.fallen) room += parameters.fallenRoom;
    if (caution.duel && (player.X_FP.translation - ball).norm() < parameters.atBall)
      room = parameters.bodyRoom;
    // Where it will be when one comes to it.
    const double away = (player.X_FP.translation - world.self.X_FR.translation).norm();
    const double ahead = std::min(parameters.lookAhead, away / parameters.pace);
    obstacles.add(player.X_FP.translation + ahead * player.v_FP, room);
  };
  for (int unum = 1; unum <= world::kTeamSize; ++unum) {
    const auto i = static_cast<std::size_t>(unum);
    if (unum != world.game.unum)
      add(world.teammates[i], unum == caution.onBall ? caution.onBallRoom : caution.robots);
    if (world.opponents[i].sigma <= kSomewhere) add(world.opponents[i], caution.robots);
  }
  if (caution.ball > 0.0 && world.ball.known) obstacles.add(ball, caution.ball);
  return obstacles;
}

// A place in somebody's room cannot be reached: the nearest one to be had instead.
Vector2 outsideOfRooms(Vector2 place, const Vector2& start, std::span<const Disc> obstacles) {
  for (const Disc& obstacle : obstacles) {
    if ((place - obstacle.p_F).norm() >= obstacle.radius) continue;
    const Vector2 towardsUs = start - obstacle.p_F;
    if (towardsUs.norm() > 1e-6) place = obstacle.p_F + obstacle.radius * towardsUs.normalized();
  }
  return place;
}

Detour wayTo(const world::WorldState& world, const NavigationParameters& parameters, const Vector2& p_FTarget,
             Obstacles obstacles, const Caution& caution) {
  addPosts(obstacles, world.field, parameters.bodyRoom);
  if (caution.wayToBall > 0.0 && world.ball.known)
    obstacles.add(world.ball.p_FB.head<2>(), caution.wayToBall);
  const Facing facing{world.self.X_FR.rotation, parameters.turnCost};
  const double squeezeFor = caution.duel ? parameters.squeezeFor : std::numeric_limits<double>::infinity();
  return detour(world.self.X_FR.translation, p_FTarget, obstacles.all(), facing, squeezeFor);
}

double roomLeft(const Vector2& start, double bodyRoom, std::span<const Disc> obstacles) {
  double left = std::numeric_limits<double>::infinity();
  for (const Disc& obstacle : obstacles) left = std::min(left, (obstacle.p_F - start).norm() - bodyRoom);
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
  // Nobody gives way on the way to the ball.
  Pose2 X_FTarget = X_FWanted;
  if (!caution.duel) X_FTarget.translation = outsideOfRooms(X_FWanted.translation, start, obstacles.all());
  const double distance = (X_FTarget.translation - start).norm();
  const bool arrived = distance < parameters.closeEnough;
  const bool crowded =
      !caution.duel && roomLeft(start, parameters.bodyRoom, obstacles.all()) < parameters.crowded;
  const Pose2 X_RF = world.self.X_FR.inverse();
  if (arrived && !crowded) {
    const motion::WalkTo last{X_RF * X_FTarget};
    if (std::abs(last.target.rotation) < parameters.facing) return motion::Stand{};
    return last;
  }
  const Detour way = wayTo(world, parameters, X_FTarget.translation, obstacles, caution);
  const double direction = directionOf(way.next - start);
  if (way.straight) {
    const double heading = distance > parameters.headingDistance ? direction : X_FTarget.rotation;
    return motion::WalkTo{X_RF * Pose2(X_FTarget.translation, heading)};
  }
  // Around somebody: as fast as to a place so far ahead, slowly where it is narrow. Giving way to somebody
  // close needs no turn.
  const double step = crowded ? parameters.slowStep : std::max(way.length, parameters.detourStep);
  const Vector2 next = start + step * unitVector(direction);
  const double heading = crowded ? world.self.X_FR.rotation : direction;
  return motion::WalkTo{X_RF * Pose2(next, heading), crowded};
}

}  // namespace nonet::team
