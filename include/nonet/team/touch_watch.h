// Who must leave the ball to somebody else: the player that took the own set piece may not touch the ball
// again before another player has (double touch rule, server facts 4.5).
#pragma once

#include "nonet/team/parameters.h"
#include "nonet/world/world_state.h"

namespace nonet::team {

class TouchWatch {
 public:
  explicit TouchWatch(const TouchParameters& parameters = {}) : parameters_(parameters) {}

  void update(const world::WorldState& world);
  /// Number of that team mate (or oneself), 0: everybody may.
  int banned() const { return taker_; }

 private:
  void findTaker(const world::WorldState& world);
  bool touchedByAnother(const world::WorldState& world) const;

  TouchParameters parameters_;
  world::Phase phase_ = world::Phase::Other;
  double takenAt_ = world::kNever;  // server time, s
  int taker_ = 0;
};

}  // namespace nonet::team
