#include "nonet/team/role_assignment.h"

#include <algorithm>
#include <bit>
#include <cassert>

namespace nonet::team {

RoleAssigner::RoleAssigner() : best_(std::size_t{1} << kMaxAssigned) {}

Assignment RoleAssigner::assign(std::span<const Vector2> players, std::span<const Vector2> positions) {
  assert(players.size() == positions.size() && players.size() <= kMaxAssigned);
  const int n = static_cast<int>(players.size());
  const std::uint32_t everybody = (1U << n) - 1U;

  // A set of k players stands for the best mapping of exactly those players to the first k positions (Theorem
  // 2: every part of an optimal mapping is optimal), so increasing bit patterns visit every smaller set
  // first.
  for (std::uint32_t set = 1; set <= everybody; ++set) {
    const int count = std::popcount(set);
    Cost& best = best_[set];
    best.lastPlayer = -1;
    for (int player = 0; player < n; ++player) {
      if (!((set >> player) & 1U)) continue;
      const double distance = (players[player] - positions[count - 1]).norm();
      const Cost& rest = best_[set & ~(1U << player)];
      Cost candidate;
      candidate.lastPlayer = player;
      const auto* restEnd = rest.distances.begin() + (count - 1);
      const auto* place =
          std::find_if(rest.distances.begin(), restEnd, [&](double d) { return d < distance; });
      auto* out = std::copy(rest.distances.begin(), place, candidate.distances.begin());
      *out++ = distance;
      std::copy(place, restEnd, out);
      const bool better =
          best.lastPlayer < 0 ||
          std::lexicographical_compare(candidate.distances.begin(), candidate.distances.begin() + count,
                                       best.distances.begin(), best.distances.begin() + count);
      if (better) best = candidate;
    }
  }

  Assignment assignment{};
  std::uint32_t set = everybody;
  for (int position = n - 1; position >= 0; --position) {
    const auto player = static_cast<std::size_t>(best_[set].lastPlayer);
    assignment[player] = position;
    set &= ~(1U << player);
  }
  return assignment;
}

}  // namespace nonet::team
