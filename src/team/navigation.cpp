#include "nonet/team/navigation.h"

#include <algorithm>
#include <cmath>

namespace nonet::team {

namespace {

// A robot that stands in the way pushes the next point of the way aside, by the more the nearer it is to the
// line.
Vector2 aroundOthers(const world::WorldState& world, const Vector2& p_FTarget, double avoidDistance) {
  const Vector2 start = world.self.X_FR.translation;
  const Vector2 way = p_FTarget - start;
  const double length = way.norm();
  if (length < 1e-3) return p_FTarget;
  const Vector2 along = way / length;
  const Vector2 aside(-along.y(), along.x());

  double nearest = length;
  double shift = 0.0;
  const auto consider = [&](const world::PlayerState& player) {
    if (!player.known) return;
    const Vector2 offset = player.X_FP.translation - start;
    const double ahead = offset.dot(along);
    const double beside = offset.dot(aside);
    if (ahead < 0.05 || ahead > std::min(nearest, 2.0) || std::abs(beside) > avoidDistance) return;
    nearest = ahead;
    // Pass on the side on which there is already more room.
    shift = beside > 0.0 ? beside - avoidDistance : beside + avoidDistance;
  };
  for (int unum = 1; unum <= world::kTeamSize; ++unum) {
    if (unum != world.game.unum) consider(world.teammates[unum]);
    consider(world.opponents[unum]);
  }
  if (shift == 0.0 || length < 0.3) return p_FTarget;
  return start + nearest * along + shift * aside;
}

}  // namespace

double headingTo(const world::WorldState& world, const Vector2& p_F) {
  const Vector2 way = p_F - world.self.X_FR.translation;
  return std::atan2(way.y(), way.x());
}

motion::MotionRequest walkTo(const world::WorldState& world, const Pose2& X_FTarget, double avoidDistance) {
  const Vector2 next = aroundOthers(world, X_FTarget.translation, avoidDistance);
  const bool detour = next != X_FTarget.translation;
  const double distance = (X_FTarget.translation - world.self.X_FR.translation).norm();
  const bool faceTheWay = detour || distance > 0.7;
  const Pose2 X_FNext(next, faceTheWay ? headingTo(world, next) : X_FTarget.rotation);

  motion::MotionRequest request;
  request.kind = motion::MotionRequest::Kind::WalkTo;
  request.target = world.self.X_FR.inverse() * X_FNext;
  request.stopAtTarget = !detour;
  // Close enough: stand instead of shuffling on the spot.
  if (!detour && distance < 0.12 && std::abs(request.target.rotation) < 0.25)
    request.kind = motion::MotionRequest::Kind::Stand;
  return request;
}

}  // namespace nonet::team
