// The team stage: WorldState -> Intent. Needs what the robot believes; gives what it wants to do in this
// cycle.
#pragma once

#include <memory>

#include "nonet/team/formation.h"
#include "nonet/team/intent.h"
#include "nonet/team/parameters.h"
#include "nonet/team/radio.h"
#include "nonet/team/role_assignment.h"
#include "nonet/world/world_state.h"

namespace nonet::team {

class Behavior {
 public:
  explicit Behavior(const TeamParameters& parameters);

  Intent update(const world::WorldState& world, bool motionBusy);

  Role role() const { return role_; }

 private:
  void updateRole(const world::WorldState& world);
  void beforeKickOff(const world::WorldState& world, Intent& intent);
  void play(const world::WorldState& world, Intent& intent);
  void goalie(const world::WorldState& world, Intent& intent);
  void searchBall(const world::WorldState& world, Intent& intent) const;
  bool ownKickOffNext(const world::WorldState& world) const;

  TeamParameters parameters_;
  RoleAssigner assigner_;
  Radio radio_;
  Role role_ = Role::Stopper;
  Vector2 roleTarget_ = Vector2::Zero();  // own field frame, m
  world::Phase lastPhase_ = world::Phase::Other;
  double lastBeam_ = world::kNever;  // server time, s
  bool beamed_ = false;
};

}  // namespace nonet::team
