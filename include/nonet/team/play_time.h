// How soon a robot could play the ball: the measure by which the team decides who goes to it.
#pragma once

#include <optional>
#include <span>

#include "nonet/math/pose2.h"
#include "nonet/team/parameters.h"
#include "nonet/world/ball_law.h"
#include "nonet/world/world_state.h"

namespace nonet::team {

/// Where a robot is and how it stands, in the own field frame.
struct Runner {
  Pose2 X_FP;
  bool headingKnown = false;
  double rises = 0.0;  // s until it is on its feet
};

/// A player as it is at `time`, server time in s.
Runner runnerOf(const world::PlayerState& player, double time, const PaceParameters& pace);

/// m from p_F (own field frame) to the nearest of these players that is known and on its feet; infinite:
/// none.
double nearestOf(std::span<const world::PlayerState> players, const Vector2& p_F);

/// Where the ball will be: flying and rolling freely, or carried on by an opponent that dribbles it and has
/// it nearer than any of us. Own field frame.
class BallForecast {
 public:
  BallForecast(const world::WorldState& world, const PaceParameters& pace);
  /// After `seconds`, if none of us touches it, m.
  Vector2 at(double seconds) const;
  /// The same if opponents let it go too.
  const world::FreeBall& free() const { return free_; }

 private:
  world::FreeBall free_;
  double longestRoll_ = 0.0;                 // s
  std::optional<Vector2> carriedWith_ = {};  // m/s, velocity of the opponent that dribbles it
};

/// Seconds until the runner can push the ball towards p_FTarget: rising, turning, the way to where the ball
/// will be then, and the way around it for a runner on the wrong side.
double timeToBall(const Runner& runner, const BallForecast& ball, const Vector2& p_FTarget,
                  const PaceParameters& pace);

}  // namespace nonet::team
