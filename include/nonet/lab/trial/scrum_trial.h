// A piece of open play around a contested or a loose ball: three robots a side, whole agents, for twelve
// seconds or until the ball leaves the field, and the same once more with the sides exchanged, so that who
// stood better at the begin does not count. How far the ball comes tells two teams apart in about a sixth of
// the time that goals take (docs/notebook.md); what the rest of a team does it does not show.
//
// The same arguments always give the same trial.
#pragma once

#include <cstdint>

#include "nonet/lab/trial/ball_trial.h"

namespace nonet::lab {

/// What the robots begin with: a ball that lies between both sides, or one that rolls anywhere at 0.5 to 3
/// m/s, with robots around it who stand anyhow and mostly farther off.
enum class ScrumBall : std::uint8_t { Contested, Loose };

struct Scrum : TrialCost {  // falls and self-collisions: of the robots of `agent`
  double gained = 0.0;      // m that the ball came towards the opponents' goal, mean of both sides
  double territory = 0.0;   // m, the same on average over the time
  double falls = 0.0;       // of one side of three, mean of both
  double opponentFalls = 0.0;
  double charges = 0.0;  // robots that made such a foul, likewise
  double opponentCharges = 0.0;
};
Scrum scrumOnce(ScrumBall ball, const agent::AgentSettings& agent, const agent::AgentSettings& opponent,
                const sim::Settings& settings, std::uint64_t seed);

}  // namespace nonet::lab
