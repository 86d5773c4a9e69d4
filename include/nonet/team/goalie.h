// The goalkeeper: between ball and goal, clears what comes near, dives for what walking does not reach.
#pragma once

#include "nonet/motion/request.h"
#include "nonet/team/parameters.h"
#include "nonet/world/world_state.h"

namespace nonet::team {

class Goalie {
 public:
  explicit Goalie(const TeamParameters& parameters);

  /// `kicking`: the last request was a kick (ball_handling.h).
  motion::MotionRequest update(const world::WorldState& world, bool mayTouch, bool kicking = false);
  /// It goes to the ball: the field players leave it to the goalie.
  bool claimsBall() const { return claims_; }

 private:
  bool dives(const world::WorldState& world, motion::MotionRequest& request) const;
  bool wantsBall(const world::WorldState& world) const;

  TeamParameters parameters_;
  bool claims_ = false;
};

}  // namespace nonet::team
