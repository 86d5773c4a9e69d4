// Oracles: brute force over all mappings, and the two algorithms against each other.
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

struct Task {
  std::vector<Vector2> players;
  std::vector<Vector2> positions;
};

/// Anywhere on the field; or on a grid of 3 x 3 points, where many ways are of the same length and some
/// players stand in the same place.
Task randomTask(Random& random, int n, bool grid) {
  Task task;
  const auto place = [&] {
    return grid ? Vector2(static_cast<double>(random.below(3)), static_cast<double>(random.below(3)))
                : Vector2(random.uniform(-15, 15), random.uniform(-10, 10));
  };
  for (int i = 0; i < n; ++i) {
    task.players.push_back(place());
    task.positions.push_back(place());
  }
  return task;
}

/// Its sorted distances; fails if it is not one-to-one.
std::vector<double> costOf(const Task& task, const Assignment& assignment) {
  const std::vector<int> mapping(assignment.begin(),
                                 assignment.begin() + static_cast<long>(task.players.size()));
  std::vector<int> sorted = mapping;
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t i = 0; i < sorted.size(); ++i) EXPECT_EQ(sorted[i], static_cast<int>(i));
  return sortedDistances(task.players, task.positions, mapping);
}

TEST(RoleAssignment, BothAlgorithmsEqualBruteForce) {
  Random random(7);
  RoleAssigner assigner;
  for (int trial = 0; trial < 4000; ++trial) {
    const int n = trial % 40 == 0 ? 7 : static_cast<int>(random.below(7));
    const Task task = randomTask(random, n, trial % 2 == 1);
    const std::vector<double> expected = bruteForce(task.players, task.positions);
    ASSERT_EQ(costOf(task, assigner.assign(task.players, task.positions)), expected) << trial;
    ASSERT_EQ(costOf(task, assignMinimalMakespan(task.players, task.positions)), expected) << trial;
  }
}

TEST(RoleAssignment, BothAlgorithmsAgreeUpToElevenPlayers) {
  Random random(8);
  RoleAssigner assigner;
  for (int trial = 0; trial < 3000; ++trial) {
    const int n = 8 + static_cast<int>(random.below(4));
    const Task task = randomTask(random, n, trial % 2 == 1);
    ASSERT_EQ(costOf(task, assignMinimalMakespan(task.players, task.positions)),
              costOf(task, assigner.assign(task.players, task.positions)))
        << trial;
  }
}

// The rule in words: of the mappings with the least cost the one whose last position has the lowest player,
// and so on to the first. Every robot must find the same one.
TEST(RoleAssignment, TiesGoToTheLowerPlayerAtTheLaterPosition) {
  Random random(9);
  RoleAssigner assigner;
  for (int trial = 0; trial < 500; ++trial) {
    const int n = 2 + static_cast<int>(random.below(5));
    const Task task = randomTask(random, n, true);
    const std::vector<double> least = bruteForce(task.players, task.positions);
    std::vector<int> playerOf(static_cast<std::size_t>(n));  // of each position, last first
    std::iota(playerOf.begin(), playerOf.end(), 0);
    // Players of the positions from the last to the first, in lexicographic order: the first that costs
    // least.
    std::vector<int> mapping(static_cast<std::size_t>(n));
    do {
      for (int k = 0; k < n; ++k) mapping[static_cast<std::size_t>(playerOf[k])] = n - 1 - k;
    } while (sortedDistances(task.players, task.positions, mapping) != least &&
             std::next_permutation(playerOf.begin(), playerOf.end()));
    const Assignment assignment = assigner.assign(task.players, task.positions);
    for (int i = 0; i < n; ++i) ASSERT_EQ(assignment[i], mapping[i]) << trial;
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
