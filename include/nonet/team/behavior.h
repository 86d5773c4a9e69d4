// The team stage: WorldState -> Intent. Needs what the robot believes; gives what it wants to do in this
// cycle.
#pragma once

#include <memory>

#include "nonet/motion/motion_state.h"
#include "nonet/team/formation.h"
#include "nonet/team/goalie.h"
#include "nonet/team/intent.h"
#include "nonet/team/navigation.h"
#include "nonet/team/parameters.h"
#include "nonet/team/radio.h"
#include "nonet/team/role_voting.h"
#include "nonet/team/touch_watch.h"
#include "nonet/world/world_state.h"

namespace nonet::team {

class Behavior {
 public:
  explicit Behavior(const TeamParameters& parameters);

  Intent update(const world::WorldState& world, const motion::MotionState& motion);

  Role role() const { return role_; }

 private:
  void beforeKickOff(const world::WorldState& world, Intent& intent);
  void agree(const world::WorldState& world);
  Tidings tidings(const world::WorldState& world) const;
  void play(const world::WorldState& world, Intent& intent);
  void fieldPlayer(const world::WorldState& world, Intent& intent) const;
  motion::MotionRequest opponentSetPiece(const world::WorldState& world) const;
  motion::MotionRequest ownSetPiece(const world::WorldState& world) const;
  motion::MotionRequest support(const world::WorldState& world, const Vector2& place) const;
  void searchBall(const world::WorldState& world, Intent& intent) const;
  bool ownKickOffNext(const world::WorldState& world) const;
  bool mayTouch(const world::WorldState& world) const { return touches_.banned() != world.game.unum; }
  /// The goalie has said that it goes to the ball.
  static bool goalieClaims(const world::WorldState& world);

  TeamParameters parameters_;
  RoleVoting voting_;
  TouchWatch touches_;
  Goalie goalie_;
  Radio radio_;
  Formation formation_;
  Role role_ = Role::Stopper;
  world::Phase lastPhase_ = world::Phase::Other;
  double lastBeam_ = world::kNever;  // server time, s
  bool beamed_ = false;
  bool kicking_ = false;  // the last request was a kick
};

}  // namespace nonet::team
