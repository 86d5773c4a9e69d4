// When to speak and what to tell the team mates.
#pragma once

#include <optional>

#include "nonet/math/inline_string.h"
#include "nonet/protocol/say_codec.h"
#include "nonet/team/parameters.h"
#include "nonet/world/world_state.h"

namespace nonet::team {

/// What a player tells beside what it knows of itself and the ball.
struct Tidings {
  std::optional<double> timeToBall;  // s; empty: it will not play the ball
  std::optional<protocol::RoleVote> vote;
};

class Radio {
 public:
  explicit Radio(const RadioParameters& parameters = {}) : parameters_(parameters) {}

  /// A report once in each of the robot's own time slots (protocol::saySlot), when it has something to tell.
  std::optional<InlineString<64>> update(const world::WorldState& world, const Tidings& tidings);

 private:
  RadioParameters parameters_;
  bool inOwnSlot_ = false;
};

}  // namespace nonet::team
