// The goalkeeper: between ball and goal, clears what comes near, dives for what walking does not reach.
#pragma once

#include "nonet/motion/request.h"
#include "nonet/team/parameters.h"
#include "nonet/world/world_state.h"

namespace nonet::team {

class Goalie {
 public:
  explicit Goalie(const TeamParameters& parameters);

  motion::MotionRequest update(const world::WorldState& world, bool mayTouch);
  /// It goes to the ball: the field players leave it to the goalie.
  bool claimsBall() const { return claims_; }

 private:
  motion::MotionRequest decide(const world::WorldState& world, bool mayTouch);
  bool dives(const world::WorldState& world, motion::MotionRequest& request) const;
  bool wantsBall(const world::WorldState& world) const;

  TeamParameters parameters_;
  bool claims_ = false;
  bool kicking_ = false;  // the last request was a kick
};

}  // namespace nonet::team
