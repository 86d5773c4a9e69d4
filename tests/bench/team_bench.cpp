// Role assignment: dynamic programming and the Hungarian method on weights 2^rank, for 2 to 11 players,
// beside dlib's Hungarian method on distances in millimetres (which minimises the sum, an easier question).
#include <cmath>
#include <vector>

#include <benchmark/benchmark.h>
#ifdef NONET_BENCH_DLIB
#include <dlib/optimization/max_cost_assignment.h>
#endif

#include "nonet/math/random.h"
#include "nonet/team/role_assignment.h"

namespace nonet::team {
namespace {

struct Task {
  std::vector<Vector2> players;
  std::vector<Vector2> positions;
};

std::vector<Task> tasks(long n) {
  Random random(3);
  std::vector<Task> made(64);
  for (Task& task : made) {
    for (long i = 0; i < n; ++i) {
      task.players.emplace_back(random.uniform(-15, 15), random.uniform(-10, 10));
      task.positions.emplace_back(random.uniform(-15, 15), random.uniform(-10, 10));
    }
  }
  return made;
}

void dynamicProgramming(benchmark::State& state) {
  const std::vector<Task> all = tasks(state.range(0));
  RoleAssigner assigner;
  std::size_t k = 0;
  for (auto _ : state) {
    const Task& task = all[k++ % all.size()];
    benchmark::DoNotOptimize(assigner.assign(task.players, task.positions));
  }
}
BENCHMARK(dynamicProgramming)->DenseRange(2, 11, 3)->Arg(10);

void minimalMakespan(benchmark::State& state) {
  const std::vector<Task> all = tasks(state.range(0));
  std::size_t k = 0;
  for (auto _ : state) {
    const Task& task = all[k++ % all.size()];
    benchmark::DoNotOptimize(assignMinimalMakespan(task.players, task.positions));
  }
}
BENCHMARK(minimalMakespan)->DenseRange(2, 11, 3)->Arg(10);

#ifdef NONET_BENCH_DLIB
void dlibHungarian(benchmark::State& state) {
  const std::vector<Task> all = tasks(state.range(0));
  const long n = state.range(0);
  std::size_t k = 0;
  for (auto _ : state) {
    const Task& task = all[k++ % all.size()];
    dlib::matrix<long> gain(n, n);  // it looks for the largest sum
    for (long i = 0; i < n; ++i) {
      for (long j = 0; j < n; ++j) {
        const Vector2 way =
            task.players[static_cast<std::size_t>(i)] - task.positions[static_cast<std::size_t>(j)];
        gain(i, j) = -std::lround(1000.0 * way.norm());
      }
    }
    benchmark::DoNotOptimize(dlib::max_cost_assignment(gain));
  }
}
BENCHMARK(dlibHungarian)->DenseRange(2, 11, 3)->Arg(10);
#endif

}  // namespace
}  // namespace nonet::team
