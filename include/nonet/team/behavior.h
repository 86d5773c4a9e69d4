// The team stage: WorldState and what motion does -> Action. Reckons the situation, lets the strategy decide,
// adds where to look and what to say.
#pragma once

#include <optional>

#include "nonet/motion/motion_state.h"
#include "nonet/team/action.h"
#include "nonet/team/challenge.h"
#include "nonet/team/parameters.h"
#include "nonet/team/radio.h"
#include "nonet/team/situation_tracker.h"
#include "nonet/world/world_state.h"

namespace nonet::team {

class Behavior {
 public:
  explicit Behavior(const TeamParameters& parameters, Challenge challenge = Challenge::None);

  /// One cycle; allocates nothing. The action is valid until the next call.
  const Action& update(const world::WorldState& world, const motion::MotionState& motion);

  /// A drill: the ball is to go there, from the next cycle on; empty: what the game asks for.
  void setIntent(const std::optional<BallIntent>& intent) { tracker_.setIntent(intent); }

  const Action& action() const { return action_; }
  Role role() const { return role_; }
  /// Roles of players 2 to 11 as this one believes them agreed; empty before the first vote.
  const std::optional<protocol::RoleVote>& agreed() const { return tracker_.agreed(); }
  /// Whether reasons tell also what was weighed (Reason::candidates).
  void recordCandidates(bool on) { tracker_.recordCandidates(on); }

 private:
  SituationTracker tracker_;
  Radio radio_;
  ChallengePlayer challenge_;
  Role role_ = Role::Stopper;
  Action action_;
};

}  // namespace nonet::team
