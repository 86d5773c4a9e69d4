// When to speak, what of, and what to tell the team mates.
//
// A listener hears one team mate in two cycles (server facts 1.7), so every number has a turn of two cycles
// (protocol::saySlot), each 0.44 s. What is told in a turn:
//   a pass        while one is about to play one
//   sightings     when one has seen opponents of whom no mate has told lately, is not near the ball, and has
//                 told enough of oneself and the ball since the last time
//   status        otherwise
// A pass may also be told out of turn: in the turn of a number that has no player; and, when neither that nor
// the own turn comes RadioParameters::passLead before the kick, in the next turn of anybody. There two speak
// at once, and whom the server takes first is heard: one of the two messages is lost.
#pragma once

#include <optional>

#include "nonet/math/inline_string.h"
#include "nonet/protocol/say_codec.h"
#include "nonet/team/action.h"
#include "nonet/team/parameters.h"
#include "nonet/world/world_state.h"

namespace nonet::team {

/// What a player tells beside what it knows of itself, the ball and the opponents.
struct Tidings {
  std::optional<double> timeToBall;  // s; empty: it will not play the ball
  std::optional<protocol::RoleVote> vote;
  std::optional<PassAnnouncement> pass{};
};

class Radio {
 public:
  explicit Radio(const RadioParameters& parameters = {}) : parameters_(parameters) {}

  /// What to say in this cycle, if anything. To be asked in each cycle.
  std::optional<InlineString<64>> update(const world::WorldState& world, const Tidings& tidings);

 private:
  bool isFree(const world::WorldState& world, int slot) const;
  bool speaksOutOfTurn(const world::WorldState& world, const PassAnnouncement& pass, int slot) const;
  bool prefersSightings(const world::WorldState& world) const;
  int findSightings(const world::WorldState& world, protocol::SayMessage& message) const;
  protocol::SayMessage report(const world::WorldState& world, const Tidings& tidings) const;

  RadioParameters parameters_;
  int slot_ = 0;                     // whose turn it was in the last cycle
  int statusSaid_ = 0;               // since the last sightings
  double passSaid_ = world::kNever;  // server time, s
};

}  // namespace nonet::team
