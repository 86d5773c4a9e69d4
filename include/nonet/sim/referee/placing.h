// How the referee moves robots (server facts 4.8): clearing of circles, halves and areas, pushing away from
// the ball, and the search for a free place.
#pragma once

#include <list>

#include "nonet/sim/referee/context.h"

namespace nonet::sim {

class Placing {
 public:
  explicit Placing(RefereeContext& context) : c_(context) {}

  enum class Where { Exactly, Safely, SafelyNearBall };
  /// Rigid move of the torso to `target`; Safely: or to the nearest free place, at least 1 m from the ball
  /// (SafelyNearBall: at any distance from it).
  void move(const Player& player, const Vector3f& target, Where where = Where::Safely);

  /// Robots of `side` whose drawn box meets the sphere are put `distance` towards their own goal.
  void clearCircle(const Vector3f& center, float radius, float distance, TeamSide side);
  /// Robots of `side` whose collider rectangle meets the box are put `distance` outside, x only.
  void clearBox(const Box2& box, float distance, TeamSide side);
  /// Both teams' places for a kick-off of `kicking` (server facts 4.3).
  void clearForKickOff(TeamSide kicking);
  /// Robots of `side` with the torso nearer than `radius` are pushed radially to `radius + margin`.
  void repel(const Vector3f& position, float radius, TeamSide side, float margin);
  /// The trainer's `(agent)`: every selected robot goes towards its own goal.
  void moveSelected();
  /// The place outside the field where a punished robot is put down, z = 1.
  Vector3f outsidePosition(const Player& player) const;

  Vector3f safePosition(const Player& player, const Vector3f& target, bool avoidBall);

 private:
  bool isFree(const Player& player, const Vector3f& position, bool avoidBall) const;
  /// Moves a candidate inside the own area, when that is full, to its front or side.
  bool keepOutOfFullArea(const Vector2f& from, const Player& player, Vector2f& candidate) const;
  void addNeighbours(const Vector2f& from, const Player& player, const Vector2f& current,
                     std::list<Vector2f>& candidates) const;
  Vector3f towardsOwnGoal(const Vector3f& from, const Vector3f& center, float distance, TeamSide side) const;

  RefereeContext& c_;
};

}  // namespace nonet::sim
