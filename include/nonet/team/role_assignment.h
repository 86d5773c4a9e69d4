// Assigns players to role positions so that the longest way is shortest, then the second longest, and so on:
// the lexicographic cost f_v of [MacAlpine 2012a, section 6.2], which [MacAlpine 2015] calls MMDR. Two
// algorithms for the same cost: dynamic programming over sets of players, which decides ties the same way in
// every robot and is what plays; and a Hungarian method, polynomial in the number of players.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "nonet/math/types.h"

namespace nonet::team {

inline constexpr int kMaxAssigned = 11;

/// assignment[player] = index of its position.
using Assignment = std::array<int, kMaxAssigned>;

/// Algorithm 1 of [MacAlpine 2012a]: n 2^(n-1) evaluations.
class RoleAssigner {
 public:
  RoleAssigner();

  /// players.size() == positions.size() <= kMaxAssigned; metres, same frame. Allocates nothing.
  /// Equal costs are resolved in favour of the lower player index, so every team mate with the same view
  /// agrees.
  Assignment assign(std::span<const Vector2> players, std::span<const Vector2> positions);

 private:
  // Ranks (distances in increasing order, equal ones the same, from 1) of the ways of the players of a set to
  // the first |set| positions, longest first, then zeros. Sixteen, so that a processor compares two words.
  using Ranks = std::array<std::uint8_t, 16>;
  std::vector<Ranks> best_;               // indexed by the bit set of players
  std::vector<std::uint8_t> lastPlayer_;  // who got the last of these positions
};

/// The same cost in O(n^5) bit operations [MacAlpine 2015, section on MMDR]: an edge weighs 2^rank, so one
/// longer way weighs more than all shorter ones together, and the least sum is the least f_v. With at most
/// 121 edges the sums fit into a word of 128 bits, and the Hungarian method takes O(n^3) steps on them. Which
/// of several mappings of the same cost it finds is another question than above. Allocates nothing.
Assignment assignMinimalMakespan(std::span<const Vector2> players, std::span<const Vector2> positions);

}  // namespace nonet::team
