#include <exception>

#include <fmt/format.h>

#include "nonet/app/commands.h"

namespace {

int run(int argc, char** argv) {
  CLI::App app{"Nonet: a RoboCup 3D soccer agent, its embedded server and its laboratory"};
  app.require_subcommand(1);
  int exitCode = 0;
  nonet::app::addPlayCommand(app, exitCode);
  nonet::app::addServeCommand(app, exitCode);
  nonet::app::addMatchCommand(app, exitCode);
  nonet::app::addSeriesCommand(app, exitCode);
  nonet::app::addStatisticsCommand(app, exitCode);
  nonet::app::addReportCommand(app, exitCode);
  nonet::app::addReplayCommand(app, exitCode);
  nonet::app::addFidelityCommand(app, exitCode);
  nonet::app::addBenchCommand(app, exitCode);
  nonet::app::addOptimizeCommand(app, exitCode);
  nonet::app::addSkillCommand(app, exitCode);
  nonet::app::addWalkReportCommand(app, exitCode);
  nonet::app::addRiseReportCommand(app, exitCode);
  nonet::app::addKickReportCommand(app, exitCode);
  CLI11_PARSE(app, argc, argv);
  return exitCode;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "nonet: {}\n", error.what());
    return 1;
  }
}
