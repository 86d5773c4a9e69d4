// Assigns players to role positions so that the longest way is shortest, then the second longest, and so on:
// the lexicographic cost f_v of [MacAlpine 2012a, section 6.2], by dynamic programming over sets of players
// (algorithm 1 there; n 2^(n-1) evaluations).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "nonet/math/types.h"

namespace nonet::team {

inline constexpr int kMaxAssigned = 10;

/// assignment[player] = index of its position.
using Assignment = std::array<int, kMaxAssigned>;

class RoleAssigner {
 public:
  RoleAssigner();

  /// players.size() == positions.size() <= kMaxAssigned; metres, same frame. Allocates nothing.
  /// Equal costs are resolved in favour of the lower player index, so every team mate with the same view
  /// agrees.
  Assignment assign(std::span<const Vector2> players, std::span<const Vector2> positions);

 private:
  // Distances of the players of a set to the first |set| positions, longest first.
  struct Cost {
    std::array<double, kMaxAssigned> distances{};
    int lastPlayer = -1;  // who got the last of these positions
  };
  std::vector<Cost> best_;  // indexed by the bit set of players
};

}  // namespace nonet::team
