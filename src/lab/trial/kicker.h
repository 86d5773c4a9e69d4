// A robot that only wants to kick: the team's own behaviours but for dribbling, on the situation of a kick
// trial.
#pragma once

#include <string>

#include "nonet/lab/trial/game_trial.h"
#include "nonet/lab/trial/kick_trial.h"
#include "nonet/math/random.h"
#include "nonet/motion/motion_state.h"
#include "nonet/team/parameters.h"
#include "nonet/team/situation.h"

namespace nonet::lab {

constexpr double kHit = 0.7;  // m/s that a kick adds at least to the ball's speed in a cycle

/// Plays the ball to a place with the kick of that name; empty: motion chooses. `stops`: and not beyond it.
class Kicker {
 public:
  Kicker(const team::TeamParameters& parameters, const Vector2& p_FTarget, const KickScene& scene);

  team::Action operator()(const world::WorldState& world, const motion::MotionState& motion);

  motion::MotionState motion;  // what motion did in the last cycle

 private:
  bool liesBehind() const;
  team::Action turnRound(const world::WorldState& world) const;

  team::TeamParameters parameters_;
  Vector2 p_FTarget_;
  InlineString<32> kick_;
  bool stops_;
  bool awaits_;
};

/// A robot, a ball and where it should go. The kicker belongs to the situation's only player.
struct KickGame {
  GameSituation situation;
  Vector2 p_FTarget = Vector2::Zero();
  std::shared_ptr<Kicker> kicker;
};
KickGame kickGame(const agent::AgentSettings& agent, const KickScene& scene, Random& random);

}  // namespace nonet::lab
