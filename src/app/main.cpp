#include <exception>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "nonet/app/commands.h"
#include "nonet/app/version.h"
#include "nonet/config/nearest.h"

namespace {

// Every wrong command line ends with this, whatever was wrong with it.
constexpr int kWrongUse = 1;

void checkCommand(const CLI::App& app, const std::string& given) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands(nullptr)) names.push_back(command->get_name());
  for (const std::string& name : names) {
    if (name == given) return;
  }
  throw std::runtime_error("there is no command '" + given + "': did you mean '" +
                           nonet::config::nearestOf(names, given) + "'? nonet --help lists all");
}

int run(int argc, char** argv) {
  CLI::App app{"Nonet: a RoboCup 3D soccer agent, its embedded server and its laboratory"};
  app.require_subcommand(1);
  app.set_version_flag("--version", nonet::app::versionText());
  int exitCode = 0;
  nonet::app::addPlayCommand(app, exitCode);
  nonet::app::addServeCommand(app, exitCode);
  nonet::app::addMatchCommand(app, exitCode);
  nonet::app::addSeriesCommand(app, exitCode);
  nonet::app::addTableCommand(app, exitCode);
  nonet::app::addStatisticsCommand(app, exitCode);
  nonet::app::addExplainCommand(app, exitCode);
  nonet::app::addViewCommand(app, exitCode);
  nonet::app::addReportCommand(app, exitCode);
  nonet::app::addReplayCommand(app, exitCode);
  nonet::app::addFidelityCommand(app, exitCode);
  nonet::app::addBenchCommand(app, exitCode);
  nonet::app::addOptimizeCommand(app, exitCode);
  nonet::app::addSkillCommand(app, exitCode);
  nonet::app::addWalkReportCommand(app, exitCode);
  nonet::app::addRiseReportCommand(app, exitCode);
  nonet::app::addKickCommand(app, exitCode);
  nonet::app::addKickReportCommand(app, exitCode);
  nonet::app::addBallReportCommand(app, exitCode);
  nonet::app::addEnvCommand(app, exitCode);
  nonet::app::addSaveReportCommand(app, exitCode);
  nonet::app::addParamsCommand(app, exitCode);
  nonet::app::addSoakCommand(app, exitCode);
  if (argc > 1 && argv[1][0] != '-') checkCommand(app, argv[1]);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kWrongUse;
  }
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
