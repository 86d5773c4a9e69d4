// Cost of a cycle of the embedded physics and of the sensors. The counter "realtime" is simulated time over
// processor time of one core.
#include <benchmark/benchmark.h>

#include "nonet/sim/fidelity/fixed_episode.h"

namespace {

using nonet::sim::WorldSettings;

void episode(benchmark::State& state, WorldSettings::Solver solver, bool rough) {
  const auto robots = static_cast<int>(state.range(0));
  const int cycles = robots == 1 ? 200 : 50;
  WorldSettings settings;
  settings.solver = solver;
  double simulated = 0.0;
  double world = 0.0;
  double senses = 0.0;
  for (auto _ : state) {
    const auto result = nonet::sim::runFixedEpisode(settings, robots, cycles, rough);
    simulated += result.simulated;
    world += result.worldSeconds;
    senses += result.senseSeconds;
  }
  state.counters["realtime"] = simulated / (world + senses);
  state.counters["physics_realtime"] = simulated / world;
  state.counters["senses_share"] = senses / (world + senses);
}

constexpr auto kExact = WorldSettings::Solver::Exact;
constexpr auto kQuick = WorldSettings::Solver::Quick;
BENCHMARK_CAPTURE(episode, exact, kExact, false)->Arg(1)->Arg(18)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(episode, quick, kQuick, false)->Arg(1)->Arg(18)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(episode, exact_pile, kExact, true)->Arg(5)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(episode, quick_pile, kQuick, true)->Arg(5)->Unit(benchmark::kMillisecond);

}  // namespace
