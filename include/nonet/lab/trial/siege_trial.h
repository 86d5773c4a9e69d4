// An attack on a wall: four of ours with the ball three to ten metres before the goal, against a goalie and
// six who stand between. Most time of games against a team that only defends is spent there
// (docs/notebook.md). Whole agents, for twenty-five seconds or until the referee stops play or the ball is
// driven away.
//
// The same arguments always give the same trial.
#pragma once

#include <cstdint>

#include "nonet/lab/trial/ball_trial.h"

namespace nonet::lab {

struct Siege : TrialCost {       // falls and self-collisions: of any of the four
  bool goal = false;             // for the four
  bool corner = false;           // for the four
  bool out = false;              // the ball left the field otherwise: goal kicks, kick-ins
  bool lost = false;             // the ball was driven 5 m away from the goal line where it began, or farther
  bool charged = false;          // one of the four was taken off for running into somebody
  bool opponentCharged = false;  // one of the others
};
Siege siegeOnce(const agent::AgentSettings& agent, const Defence& defence, const sim::Settings& settings,
                std::uint64_t seed);

}  // namespace nonet::lab
