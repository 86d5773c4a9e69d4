// Passes: to whom, where that one can meet the ball, with which kick. The receiver hears of it before the
// kick (PassAnnouncement in action.h) and runs.
//
//   V = P(kick comes off) * [ P(nobody stops the ball) * V(place, P(receiver is first)) + P(stopped) *
//   V(there) ]
//       + P(kick does not come off) * V(ball, contested)
//
// with the worth of places, times and probabilities of ball_choice.h. The receiver runs from now on,
// opponents only from the kick on, since they do not know.
#pragma once

#include <optional>
#include <string_view>

#include "nonet/team/situation.h"

namespace nonet::team {

struct Pass {
  int receiver = 0;                     // number of the team mate
  Vector2 p_FTarget = Vector2::Zero();  // where the ball is to come to rest, own field frame, m
  std::string_view kick;                // name of the kick
  double untilKick = 0.0;               // s from now until the foot meets the ball
  double untilThere = 0.0;              // s from now until the ball can be taken
  double value = 0.0;                   // goals
};

/// The most valuable pass of the one whose turn it is; nothing if none is worth more than running on with the
/// ball, or likely to arrive. Candidates are written to `record` unless it is null.
std::optional<Pass> bestPass(const Situation& situation, Candidates* record = nullptr);

}  // namespace nonet::team
