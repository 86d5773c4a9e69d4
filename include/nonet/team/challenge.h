// The technical challenges of the league: one robot alone, or few, with a task of their own instead of a
// match.
//
// Run: from its place straight ahead, as fast as it can. Kick: the ball that lies there to the centre spot,
// with one kick. Goalie, passing and keep-away are played as a match is.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "nonet/team/action.h"
#include "nonet/team/situation.h"

namespace nonet::team {

enum class Challenge : std::uint8_t { None, Run, Kick, Goalie, Passing, KeepAway };

/// Finds the word in any spelling: "run", "RunChallenge", "keep-away". Nothing for other names.
std::optional<Challenge> challengeFromName(std::string_view name);
std::string_view challengeName(Challenge challenge);

class ChallengePlayer {
 public:
  explicit ChallengePlayer(Challenge challenge) : challenge_(challenge) {}

  /// What to do instead of what the strategy wants; nothing where that is right: before the kick-off, while
  /// the body is busy, and in challenges that are played as a match is.
  std::optional<Action> update(const Situation& situation);

 private:
  Action run(const Situation& situation);
  std::optional<Action> kickToCentre(const Situation& situation);

  Challenge challenge_;
  std::optional<Vector2> start_;  // place at the begin (run) or of the ball (kick), own field frame, m
  bool near_ = false;             // kick: has been at the ball
  bool kicked_ = false;
};

}  // namespace nonet::team
