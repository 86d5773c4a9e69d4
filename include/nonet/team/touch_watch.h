// Who must leave something to somebody else until another player has touched the ball: the player that took
// the own set piece may not touch the ball again (double touch rule, server facts 4.5), and who kicked in the
// own pass mode cannot score (4.9).
#pragma once

#include "nonet/team/parameters.h"
#include "nonet/world/world_state.h"

namespace nonet::team {

/// One other player is known at most, an opponent as in a penalty shoot-out or a mate: who takes the kick-off
/// may go on with the ball (server facts 4.3).
bool atMostTwoPlay(const world::WorldState& world);

class TouchWatch {
 public:
  explicit TouchWatch(const TouchParameters& parameters = {}) : parameters_(parameters) {}

  void update(const world::WorldState& world);
  /// Number of the team mate (or oneself) that may not touch the ball, 0: everybody may.
  int banned() const { return taker_.unum; }
  /// Number of the one that cannot score, 0: everybody can.
  int barred() const { return passer_.unum; }

 private:
  struct Kicker {
    int unum = 0;
    double at = world::kNever;  // server time, s
  };

  bool awaitsGoalKick(const world::WorldState& world) const;
  Kicker takerOf(world::Phase piece, const world::WorldState& world) const;
  Kicker nearestAtBall(const world::WorldState& world, bool opponentsToo) const;
  bool touchedByAnother(const world::WorldState& world, const Kicker& kicker, bool opponentsToo) const;

  TouchParameters parameters_;
  world::Phase phase_ = world::Phase::Other;
  Kicker goalKicker_;  // who was at the ball when it last lay still for the own goal kick
  Kicker taker_;
  Kicker passer_;
};

}  // namespace nonet::team
