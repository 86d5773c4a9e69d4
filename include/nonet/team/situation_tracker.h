// WorldState -> Situation: what must be remembered from cycle to cycle for it.
#pragma once

#include <optional>

#include "nonet/team/role_voting.h"
#include "nonet/team/situation.h"
#include "nonet/team/touch_watch.h"

namespace nonet::team {

class SituationTracker {
 public:
  explicit SituationTracker(const TeamParameters& parameters);

  /// The situation points to `world`, `motion` and into this object: it is valid until the next call.
  Situation update(const world::WorldState& world, const motion::MotionState& motion);
  /// It is this player's turn, and this is its play, until the intent is taken back.
  void setIntent(const std::optional<BallIntent>& intent) { intent_ = intent; }
  /// The robot asked to be beamed in this cycle.
  void noticeBeam(double time) { lastBeam_ = time; }
  /// For the own next message: role of players 2 to 11; empty without a view of the field.
  const std::optional<protocol::RoleVote>& vote() const { return voting_.vote(); }
  /// What all should do, as this player counts the votes; empty before the first.
  const std::optional<protocol::RoleVote>& agreed() const { return voting_.agreed(); }

  /// Whether choices write down what they weighed.
  void recordCandidates(bool on) { recording_ = on; }

 private:
  TeamParameters parameters_;
  RoleVoting voting_;
  TouchWatch touches_;
  Candidates targets_;
  std::optional<BallIntent> intent_;
  std::optional<double> planned_;    // where a set piece was to go in the last cycle, likewise
  std::optional<double> direction_;  // where the ball was to go in the last cycle, rad, own field frame
  bool recording_ = false;
  bool claims_ = false;              // the goalie goes to the ball
  double lastBeam_ = world::kNever;  // server time, s
};

}  // namespace nonet::team
