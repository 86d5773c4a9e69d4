#include "nonet/sim/referee/placing.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <spdlog/spdlog.h>

namespace nonet::sim {

void Placing::move(const Player& player, const Vector3f& target, Where where) {
  c_.records.of(player).sinceMoved = 0;
  const Vector3f place =
      where == Where::Exactly ? target : safePosition(player, target, where == Where::Safely);
  c_.world.moveRobot(player.robot, place);
}

Vector3f Placing::towardsOwnGoal(const Vector3f& from, const Vector3f& center, float distance,
                                 TeamSide side) const {
  Vector3f place = from;
  const float x = side == TeamSide::Left ? center.x() - distance : center.x() + distance;
  if (std::abs(x) > c_.halfLength() && (x < 0.0F) == (side == TeamSide::Left)) {
    // Beyond the goal line: sideways, towards the x axis.
    place.y() = center.y() < 0.0F ? center.y() + distance : center.y() - distance;
  } else {
    place.x() = x;
  }
  return place;
}

void Placing::clearCircle(const Vector3f& center, float radius, float distance, TeamSide side) {
  if (side == TeamSide::None) return;
  for (const Player* player : c_.shuffledTeam(side)) {
    if (!sphereMeetsBox(center, radius, drawnBox(c_.world, player->robot))) continue;
    move(*player, towardsOwnGoal(c_.torso(*player), center, distance, side));
  }
}

void Placing::clearBox(const Box2& box, float distance, TeamSide side) {
  if (side == TeamSide::None) return;
  for (const Player* player : c_.shuffledTeam(side)) {
    if (!box.meets(colliderRectangle(c_.world, player->robot))) continue;
    Vector3f place = c_.torso(*player);
    place.x() = side == TeamSide::Left ? box.low.x() - distance : box.high.x() + distance;
    move(*player, place);
  }
}

void Placing::clearForKickOff(TeamSide kicking) {
  if (c_.settings.startAnyFieldPosition || kicking == TeamSide::None) return;
  const float distance = static_cast<float>(c_.settings.freeKickMoveDist);
  const float radius = static_cast<float>(c_.settings.freeKickDistance);
  const TeamSide waiting = opponentOf(kicking);
  clearBox(waiting == TeamSide::Right ? c_.areas.leftHalf : c_.areas.rightHalf, distance, waiting);
  clearCircle(Vector3f::Zero(), radius, distance, waiting);

  const Box2& wrongHalf = kicking == TeamSide::Right ? c_.areas.leftHalf : c_.areas.rightHalf;
  for (const Player* player : c_.shuffledTeam(kicking)) {
    const Box2 rectangle = colliderRectangle(c_.world, player->robot);
    if (!wrongHalf.meets(rectangle)) continue;
    const auto inCircle = [&](float x, float y) { return Vector2f(x, y).squaredNorm() < radius * radius; };
    if (inCircle(rectangle.low.x(), rectangle.low.y()) && inCircle(rectangle.high.x(), rectangle.high.y()) &&
        inCircle(rectangle.low.x(), rectangle.high.y()) && inCircle(rectangle.high.x(), rectangle.low.y())) {
      continue;
    }
    Vector3f place = c_.torso(*player);
    place.x() = kicking == TeamSide::Left ? wrongHalf.low.x() - distance : wrongHalf.high.x() + distance;
    move(*player, place);
  }
}

void Placing::repel(const Vector3f& position, float radius, TeamSide side, float margin) {
  if (side == TeamSide::None) return;
  for (const Player* player : c_.shuffledTeam(side)) {
    Vector3f place = c_.torso(*player);
    if (horizontalDistance(place, position) >= radius) continue;
    const Vector2f away = directionOf(place.head<2>() - position.head<2>());
    place.head<2>() = position.head<2>() + away * (radius + margin);
    move(*player, place, Where::SafelyNearBall);
  }
}

void Placing::moveSelected() {
  const float distance = static_cast<float>(c_.settings.freeKickMoveDist);
  for (const Player* player : c_.shuffledTeam(TeamSide::None)) {
    if (!player->selected) continue;
    const Vector3f from = c_.sceneTorso(*player);
    move(*player, towardsOwnGoal(from, from, distance, player->side));
  }
}

Vector3f Placing::outsidePosition(const Player& player) const {
  const float step = player.side == TeamSide::Left ? -0.6F : 0.6F;
  const float y = c_.halfWidth() + 0.5F;
  const bool ballBelow = c_.world.ballPosition().y() < 0.0F;
  return Vector3f(step * static_cast<float>(7 - player.unum), ballBelow ? y : -y, 1.0F);
}

bool Placing::isFree(const Player& player, const Vector3f& position, bool avoidBall) const {
  const float radius = c_.agentRadius();
  const float goalHalf = static_cast<float>(c_.settings.goalWidth) / 2.0F;
  if (std::abs(position.x()) > c_.halfLength() && std::abs(position.y()) < goalHalf + radius) return false;
  if (avoidBall) {
    const float distance = std::max(radius * 2.0F, static_cast<float>(c_.settings.passModeMinOppBallDist));
    if (horizontalDistance(c_.world.ballPosition(), position) < distance) return false;
  }
  for (const Player& other : c_.players) {
    if (other.side == TeamSide::None || (other.side == player.side && other.unum == player.unum)) continue;
    if (sphereMeetsBox(position, radius, drawnBox(c_.world, other.robot))) return false;
  }
  return true;
}

bool Placing::keepOutOfFullArea(const Vector2f& from, const Player& player, Vector2f& candidate) const {
  const SideRecord& team = c_.records.of(player.side);
  if (c_.records.of(player).insideOwnArea ||
      team.insideCount + team.movedInside < c_.settings.maxPlayersInsideOwnArea) {
    return false;
  }
  const float margin = c_.agentRadius();
  const Box2& area = c_.ownArea(player.side);
  const bool inside = candidate.x() > area.low.x() - margin && candidate.x() < area.high.x() + margin &&
                      candidate.y() > area.low.y() - margin && candidate.y() < area.high.y() + margin;
  if (!inside) return false;
  const bool left = player.side == TeamSide::Left;
  if (left ? candidate.x() > from.x() : candidate.x() < from.x()) {
    candidate.x() = left ? area.high.x() + margin : area.low.x() - margin;  // beyond its front
  } else if (candidate.y() > from.y() || (candidate.y() == from.y() && candidate.y() < 0.0F)) {
    candidate.y() = area.high.y() + margin;
  } else {
    candidate.y() = area.low.y() - margin;
  }
  return true;
}

void Placing::addNeighbours(const Vector2f& from, const Player& player, const Vector2f& current,
                            std::list<Vector2f>& candidates) const {
  const float radius = c_.agentRadius();
  const bool left = player.side == TeamSide::Left;
  std::vector<Vector2f> neighbours;
  const auto consider = [&](Vector2f place, bool checkGoalLine) {
    if (checkGoalLine && std::abs(place.x()) > c_.halfLength()) return;
    keepOutOfFullArea(from, player, place);
    neighbours.push_back(place);
  };
  // Away from where the robot comes from; both ways if it is level with the place.
  const float awayX =
      left ? (from.x() < current.x() ? 1.0F : -1.0F) : (from.x() > current.x() ? -1.0F : 1.0F);
  consider(current + Vector2f(radius * awayX, 0.0F), true);
  if (current.x() == from.x()) consider(current + Vector2f(left ? radius : -radius, 0.0F), true);
  if (current.y() == from.y()) {
    const float inwards = from.y() < 0.0F ? 1.0F : -1.0F;
    consider(current + Vector2f(0.0F, radius * inwards), false);
    consider(current + Vector2f(0.0F, -radius * inwards), false);
  } else {
    consider(current + Vector2f(0.0F, from.y() < current.y() ? radius : -radius), false);
  }
  for (const Vector2f& place : neighbours) {
    const float distance = (place - from).norm();
    bool add = true;
    auto at = candidates.end();
    for (; at != candidates.begin(); --at) {
      const Vector2f& known = *std::prev(at);
      add = (known - place).norm() >= radius / 2.0F;
      if (!add || distance >= (known - from).norm()) break;
    }
    if (add) candidates.insert(at, place);
  }
}

Vector3f Placing::safePosition(const Player& player, const Vector3f& target, bool avoidBall) {
  if (c_.settings.maxNumSafeRepositionAttempts == 0 || player.side == TeamSide::None ||
      c_.agentRadius() <= 0.0F) {
    return target;
  }
  const Vector2f from = c_.torso(player).head<2>();
  std::list<Vector2f> candidates;
  Vector3f place = target;
  const auto takeNext = [&] {
    place.head<2>() = candidates.front();
    candidates.pop_front();
  };
  const auto failed = [&] {
    spdlog::warn("referee: no free place found for player {} ({})", player.unum, sideName(player.side));
  };
  Vector2f shifted = target.head<2>();
  if (keepOutOfFullArea(from, player, shifted)) {
    addNeighbours(from, player, target.head<2>(), candidates);
    if (candidates.empty()) {
      failed();
      return target;
    }
    takeNext();
  }
  bool found = false;
  for (int attempt = 0; attempt < c_.settings.maxNumSafeRepositionAttempts; ++attempt) {
    found = isFree(player, place, avoidBall);
    if (found) break;
    addNeighbours(from, player, place.head<2>(), candidates);
    if (candidates.empty()) break;
    takeNext();
  }
  if (!found) {
    failed();
    place = target;
  }
  const bool inside = c_.ownArea(player.side).contains(place.head<2>());
  const bool wasInside = c_.records.of(player).insideOwnArea;
  if (!wasInside && inside) ++c_.records.of(player.side).movedInside;
  if (wasInside && !inside) --c_.records.of(player.side).movedInside;
  return place;
}

}  // namespace nonet::sim
