#include "nonet/team/role_assignment.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <limits>

namespace nonet::team {

namespace {

constexpr std::size_t kMost = kMaxAssigned;

// Distances of players (rows) from positions, in increasing order: rank[player][position] is the number of
// shorter edges. Equal distances share a rank and leave a gap behind it.
struct EdgeRanks {
  std::array<std::array<std::uint8_t, kMost>, kMost> rank{};

  EdgeRanks(std::span<const Vector2> players, std::span<const Vector2> positions) {
    struct Edge {
      double distance;
      std::uint8_t player;
      std::uint8_t position;
    };
    std::array<Edge, kMost * kMost> edges{};
    std::size_t count = 0;
    for (std::size_t i = 0; i < players.size(); ++i) {
      for (std::size_t j = 0; j < positions.size(); ++j) {
        edges[count++] = {(players[i] - positions[j]).norm(), static_cast<std::uint8_t>(i),
                          static_cast<std::uint8_t>(j)};
      }
    }
    std::sort(edges.begin(), edges.begin() + count,
              [](const Edge& a, const Edge& b) { return a.distance < b.distance; });
    std::size_t first = 0;  // of those that are as long
    for (std::size_t k = 0; k < count; ++k) {
      if (edges[k].distance > edges[first].distance) first = k;
      rank[edges[k].player][edges[k].position] = static_cast<std::uint8_t>(first);
    }
  }
};

// 2^rank of at most 121 edges, and sums and differences of them.
__extension__ using Weight = __int128;

}  // namespace

RoleAssigner::RoleAssigner()
    : best_(std::size_t{1} << kMaxAssigned), lastPlayer_(std::size_t{1} << kMaxAssigned) {}

Assignment RoleAssigner::assign(std::span<const Vector2> players, std::span<const Vector2> positions) {
  assert(players.size() == positions.size() && players.size() <= kMost);
  const int n = static_cast<int>(players.size());
  const std::uint32_t everybody = (1U << n) - 1U;
  const EdgeRanks edges(players, positions);

  // A set of k players stands for the best mapping of exactly those players to the first k positions (Theorem
  // 2: every part of an optimal mapping is optimal), so increasing bit patterns visit every smaller set
  // first.
  for (std::uint32_t set = 1; set <= everybody; ++set) {
    const auto position = static_cast<std::size_t>(std::popcount(set) - 1);
    Ranks best;
    best.fill(255);
    for (std::uint32_t left = set; left != 0; left &= left - 1) {
      const auto player = static_cast<std::size_t>(std::countr_zero(left));
      const Ranks& rest = best_[set & ~(1U << player)];
      const auto rank = static_cast<std::uint8_t>(edges.rank[player][position] + 1);
      // Into its place among the rest: where it is longer than what stands there, that moves one on.
      Ranks candidate;
      candidate[0] = std::max(rest[0], rank);
      for (std::size_t k = 1; k < candidate.size(); ++k)
        candidate[k] = std::max(rest[k], std::min(rest[k - 1], rank));
      if (candidate < best) {
        best = candidate;
        lastPlayer_[set] = static_cast<std::uint8_t>(player);
      }
    }
    best_[set] = best;
  }

  Assignment assignment{};
  std::uint32_t set = everybody;
  for (int position = n - 1; position >= 0; --position) {
    const auto player = static_cast<std::size_t>(lastPlayer_[set]);
    assignment[player] = position;
    set &= ~(1U << player);
  }
  return assignment;
}

// The Hungarian method in its form with shortest augmenting paths: player by player the mapping grows, along
// the path of the least added weight. Row and column 0 stand for "nobody".
Assignment assignMinimalMakespan(std::span<const Vector2> players, std::span<const Vector2> positions) {
  assert(players.size() == positions.size() && players.size() <= kMost);
  const std::size_t n = players.size();
  const EdgeRanks edges(players, positions);
  const auto weight = [&](std::size_t row, std::size_t column) {
    return Weight{1} << edges.rank[row - 1][column - 1];
  };
  // A path takes each edge at most once, so its weight is below 2^121, and what a potential gathers in 11
  // rounds below 2^125.
  constexpr Weight kFar = std::numeric_limits<Weight>::max();
  std::array<Weight, kMost + 1> rowPotential{};
  std::array<Weight, kMost + 1> columnPotential{};
  std::array<std::size_t, kMost + 1> rowOf{};  // of a column; 0: free
  for (std::size_t newRow = 1; newRow <= n; ++newRow) {
    std::array<Weight, kMost + 1> shortest{};
    std::array<std::size_t, kMost + 1> from{};  // column before this one on the path
    std::array<bool, kMost + 1> reached{};
    shortest.fill(kFar);
    rowOf[0] = newRow;
    std::size_t column = 0;
    while (rowOf[column] != 0) {
      reached[column] = true;
      const std::size_t row = rowOf[column];
      std::size_t next = 0;
      Weight step = kFar;
      for (std::size_t j = 1; j <= n; ++j) {
        if (reached[j]) continue;
        const Weight way = weight(row, j) - rowPotential[row] - columnPotential[j];
        if (way < shortest[j]) {
          shortest[j] = way;
          from[j] = column;
        }
        if (shortest[j] < step) {
          step = shortest[j];
          next = j;
        }
      }
      for (std::size_t j = 0; j <= n; ++j) {
        if (reached[j]) {
          rowPotential[rowOf[j]] += step;
          columnPotential[j] -= step;
        } else if (j > 0) {
          shortest[j] -= step;
        }
      }
      column = next;
    }
    for (; column != 0; column = from[column]) rowOf[column] = rowOf[from[column]];
  }
  Assignment assignment{};
  for (std::size_t j = 1; j <= n; ++j) assignment[rowOf[j] - 1] = static_cast<int>(j) - 1;
  return assignment;
}

}  // namespace nonet::team
