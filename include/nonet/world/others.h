// Everybody on the field but oneself.
#pragma once

#include <algorithm>

#include "nonet/world/world_state.h"

namespace nonet::world {

/// Whether `is` holds for a known robot of either team other than one's own.
template <class Predicate>
bool anyOther(const WorldState& world, Predicate&& is) {
  const auto known = [&](const PlayerState& player) { return player.known && is(player); };
  const auto& mates = world.teammates;
  const auto self = mates.begin() + std::clamp(world.game.unum, 0, kTeamSize);
  return std::any_of(mates.begin(), self, known) || std::any_of(self + 1, mates.end(), known) ||
         std::any_of(world.opponents.begin(), world.opponents.end(), known);
}

}  // namespace nonet::world
