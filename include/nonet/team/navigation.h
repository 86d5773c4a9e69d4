// Going to a place on the field without running into anybody.
#pragma once

#include "nonet/math/pose2.h"
#include "nonet/motion/request.h"
#include "nonet/team/parameters.h"
#include "nonet/world/world_state.h"

namespace nonet::team {

/// What to keep clear of on the way.
struct Caution {
  double robots = 0.7;      // m from robot to robot
  double ball = 0.0;        // m; 0: the ball may be touched
  double wayToBall = 0.0;   // m that ways keep from the ball, if more; places may lie nearer
  int onBall = 0;           // number of the team mate on the ball, which gets more room; 0: none
  double onBallRoom = 1.0;  // m from it
  bool duel = false;        // on the way to the ball: robots at the ball are no reason to stay away
};

/// A walk to X_FWanted (own field frame). Far away the robot faces its way, near by it takes the target's
/// heading. It goes around what is in the way, slows down near others, and gives way to who comes too near.
motion::MotionRequest walkTo(const world::WorldState& world, const NavigationParameters& parameters,
                             const Pose2& X_FWanted, const Caution& caution);

/// Heading from the robot to a point of the field, in the field frame, rad.
double headingTo(const world::WorldState& world, const Vector2& p_F);

}  // namespace nonet::team
