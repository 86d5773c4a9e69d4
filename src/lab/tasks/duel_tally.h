// Some duels for the ball (lab/trial/ball_trial.h), as tasks count them.
#pragma once

#include "nonet/lab/trial/ball_trial.h"
#include "nonet/math/random.h"

namespace nonet::lab {

struct DuelTally {
  double won = 0.0;  // share
  int falls = 0;     // duels in which the robot fell
};

inline DuelTally fightDuels(int duels, const agent::AgentSettings& agent,
                            const agent::AgentSettings& opponent, const sim::Settings& server,
                            Random& random) {
  DuelTally tally;
  for (int i = 0; i < duels; ++i) {
    const Duel duel = duelOnce(agent, opponent, server, random.next());
    tally.won += duel.won / duels;
    tally.falls += duel.fell ? 1 : 0;
  }
  return tally;
}

}  // namespace nonet::lab
