// Oracle: brute force over all mappings.
#include "nonet/team/role_assignment.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "nonet/math/random.h"

namespace nonet::team {
namespace {

std::vector<double> sortedDistances(const std::vector<Vector2>& players,
                                    const std::vector<Vector2>& positions, const std::vector<int>& mapping) {
  std::vector<double> distances;
  for (std::size_t i = 0; i < players.size(); ++i)
    distances.push_back((players[i] - positions[mapping[i]]).norm());
  std::sort(distances.rbegin(), distances.rend());
  return distances;
}

std::vector<double> bruteForce(const std::vector<Vector2>& players, const std::vector<Vector2>& positions) {
  std::vector<int> mapping(players.size());
  std::iota(mapping.begin(), mapping.end(), 0);
  std::vector<double> best = sortedDistances(players, positions, mapping);
  while (std::next_permutation(mapping.begin(), mapping.end()))
    best = std::min(best, sortedDistances(players, positions, mapping));
  return best;
}

TEST(RoleAssignment, EqualsBruteForceOnRandomTeams) {
  Random random(7);
  RoleAssigner assigner;
  for (int trial = 0; trial < 300; ++trial) {
    const int n = 1 + static_cast<int>(random.below(7));
    std::vector<Vector2> players;
    std::vector<Vector2> positions;
    for (int i = 0; i < n; ++i) {
      players.emplace_back(random.uniform(-15, 15), random.uniform(-10, 10));
      positions.emplace_back(random.uniform(-15, 15), random.uniform(-10, 10));
    }
    const Assignment assignment = assigner.assign(players, positions);
    std::vector<int> mapping(assignment.begin(), assignment.begin() + n);
    std::vector<int> sorted = mapping;
    std::sort(sorted.begin(), sorted.end());
    for (int i = 0; i < n; ++i) ASSERT_EQ(sorted[i], i) << "not a one-to-one mapping";
    const std::vector<double> found = sortedDistances(players, positions, mapping);
    const std::vector<double> expected = bruteForce(players, positions);
    for (int i = 0; i < n; ++i) ASSERT_DOUBLE_EQ(found[i], expected[i]);
  }
}

TEST(RoleAssignment, ReproducesTheOrderOfFigure6) {
  // Figure 6: A1 -> P1 (1), A2 -> P2 (sqrt 2), A3 -> P3 (sqrt 2) is the lowest of the six costs.
  const std::vector<Vector2> players = {{0, 0}, {1, 1}, {2, 1}};
  const std::vector<Vector2> positions = {{1, 0}, {2, 0}, {3, 0}};
  RoleAssigner assigner;
  const Assignment assignment = assigner.assign(players, positions);
  EXPECT_EQ(assignment[0], 0);
  EXPECT_EQ(assignment[1], 1);
  EXPECT_EQ(assignment[2], 2);
}

TEST(RoleAssignment, StaysTheSameWhilePlayersWalkStraightToTheirTargets) {
  // Property 3 of [MacAlpine 2012a, section 6.2.1]: dynamic consistency.
  Random random(11);
  RoleAssigner assigner;
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<Vector2> players;
    std::vector<Vector2> positions;
    for (int i = 0; i < 8; ++i) {
      players.emplace_back(random.uniform(-15, 15), random.uniform(-10, 10));
      positions.emplace_back(random.uniform(-15, 15), random.uniform(-10, 10));
    }
    const Assignment first = assigner.assign(players, positions);
    for (int step = 0; step < 200; ++step) {
      for (std::size_t i = 0; i < players.size(); ++i) {
        const Vector2 way = positions[first[i]] - players[i];
        players[i] += way.normalized() * std::min(way.norm(), 0.1);
      }
      const Assignment now = assigner.assign(players, positions);
      for (int i = 0; i < 8; ++i) {
        // Players that have arrived at the same cost may be exchanged only if nothing gets worse: same cost
        // tuple.
        if (now[i] == first[i]) continue;
        const std::vector<int> a(first.begin(), first.begin() + 8);
        const std::vector<int> b(now.begin(), now.begin() + 8);
        const auto costA = sortedDistances(players, positions, a);
        const auto costB = sortedDistances(players, positions, b);
        for (std::size_t k = 0; k < costA.size(); ++k) ASSERT_NEAR(costA[k], costB[k], 1e-9);
      }
    }
  }
}

}  // namespace
}  // namespace nonet::team
