// When to speak and what to tell the team mates.
#pragma once

#include <optional>

#include "nonet/math/inline_string.h"
#include "nonet/world/world_state.h"

namespace nonet::team {

class Radio {
 public:
  /// A report once in each of the robot's own time slots (protocol::saySlot), when it has something to tell.
  std::optional<InlineString<64>> update(const world::WorldState& world);

 private:
  bool inOwnSlot_ = false;
};

}  // namespace nonet::team
