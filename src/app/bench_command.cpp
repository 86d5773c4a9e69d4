#include <fmt/format.h>

#include "nonet/app/commands.h"
#include "nonet/sim/fidelity/fixed_episode.h"

namespace nonet::app {
namespace {

constexpr int kSignatureRobots = 5;
constexpr int kSignatureCycles = 150;

void printSpeed(const char* name, sim::WorldSettings::Solver solver, int robots, int cycles, int threads) {
  sim::WorldSettings settings;
  settings.solver = solver;
  settings.threads = threads;
  const sim::EpisodeResult result = sim::runFixedEpisode(settings, robots, cycles, false);
  const double perCycle = 1000.0 / cycles;
  fmt::print("{:<24} physics {:7.3f} ms, senses {:6.3f} ms per cycle: {:6.1f} times real time per core\n",
             name, perCycle * result.worldSeconds, perCycle * result.senseSeconds,
             result.simulated / (result.worldSeconds + result.senseSeconds));
}

int runBench(int threads) {
  sim::WorldSettings settings;
  settings.threads = threads;
  const sim::EpisodeResult exact = sim::runFixedEpisode(settings, kSignatureRobots, kSignatureCycles, true);
  fmt::print("signature {:016x}\n", exact.signature);
  using Solver = sim::WorldSettings::Solver;
  printSpeed("one robot, exact", Solver::Exact, 1, 500, threads);
  printSpeed("one robot, quick", Solver::Quick, 1, 1000, threads);
  printSpeed("eighteen robots, exact", Solver::Exact, 18, 100, threads);
  printSpeed("eighteen robots, quick", Solver::Quick, 18, 200, threads);
  return 0;
}

}  // namespace

void addBenchCommand(CLI::App& app, int& exitCode) {
  CLI::App* command =
      app.add_subcommand("bench", "Prints the signature of a fixed episode, and what a cycle of it costs");
  auto threads = std::make_shared<int>(1);
  command->add_option("--threads", *threads, "Threads of the physics; the signature does not depend on them")
      ->check(CLI::Range(1, 64));
  command->footer(
      "Example: nonet bench --threads 2\nTimes are processor times, so they do not depend on what else the "
      "machine does.");
  command->callback([threads, &exitCode] { exitCode = runBench(*threads); });
}

}  // namespace nonet::app
