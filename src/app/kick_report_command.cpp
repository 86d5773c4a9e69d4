// nonet kick-report: how far, how straight and how soon the robot kicks.
#include <memory>
#include <stdexcept>
#include <string>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "nonet/agent/agent_setup.h"
#include "nonet/app/agent_options.h"
#include "nonet/app/commands.h"
#include "nonet/app/console.h"
#include "nonet/app/data_folder.h"
#include "nonet/app/kick_options.h"
#include "nonet/lab/reports/kick_report.h"

namespace nonet::app {

namespace {

struct KickReportArguments {
  agent::AgentChoice choice;
  lab::KickReportSettings settings;
  std::string data;
  ServerChoice server;
  std::string svg;
  bool json = false;
};

int run(const KickReportArguments& arguments) {
  spdlog::set_level(spdlog::level::warn);  // who enters the field is no news here
  lab::KickReportSettings settings = arguments.settings;
  if (settings.stops && settings.kick != "any")
    throw std::runtime_error("--stop is for the kick that motion chooses: leave it out, or give --kick any");
  settings.seed = arguments.choice.seed;
  settings.agent = agent::makeAgentSettings(arguments.choice, dataFolder(arguments.data));
  settings.server = arguments.server.chosen();
  const std::vector<lab::KickMeasures> report = measureShown(settings, lab::measureKicks);
  fmt::print("{}", arguments.json ? lab::kickReportJson(report, settings) : lab::kickReportTable(report));
  if (arguments.svg.empty()) return 0;
  for (const lab::KickMeasures& kick : report) {
    const std::string path = fmt::format("{}{}.svg", arguments.svg, kick.name);
    writeAndName(path, lab::kickReportSvg(kick, settings));
  }
  return 0;
}

}  // namespace

void addKickReportCommand(CLI::App& app, int& exitCode) {
  CLI::App* command = app.add_subcommand(
      "kick-report", "Measure seeded kicks with their approach: distance, height, direction, time, falls");
  const auto arguments = std::make_shared<KickReportArguments>();
  lab::KickReportSettings& settings = arguments->settings;
  addAgentOptions(*command, arguments->choice, arguments->data);
  command->add_option("--kick", settings.kick, "Name of a kick, all, or any: the one that motion chooses");
  command->add_option("--trials,--kicks", settings.trials, "Kicks of each kind")
      ->check(CLI::Range(1, 100000));
  addKickOptions(*command, settings);
  command->add_option("--pushed", settings.pushed, "Speed at which it rolls to the target at the begin, m/s")
      ->check(CLI::Range(0.0, 3.0));
  command
      ->add_option(
          "--passed", settings.passed,
          "Speed at which it comes at the begin, from either side or from the target, as a pass that "
          "rolls out before the waiting robot, m/s; --start says nothing then")
      ->check(CLI::Range(0.0, 4.0))
      ->excludes("--pushed")
      ->excludes("--rolling");
  command->add_flag("--stop", settings.stops,
                    "With --kick any: it should come to rest there, motion chooses as for a pass");
  command->add_option("--seed", arguments->choice.seed, "Seed of all kicks");
  addServerOptions(*command, arguments->server);
  command->add_option("--svg", arguments->svg, "Draw the balls' ways: SVG + name of the kick + .svg");
  command->add_flag("--json", arguments->json, "Print JSON");
  command->footer(
      "Examples:\n  nonet kick-report --type 4\n  nonet kick-report --kick kick_power --json\n"
      "  nonet kick-report --kick any --rolling 0.3 --start 1.5 --svg fan_\n"
      "  nonet kick-report --kick any --distance 4 --stop  # a pass of 4 m\n"
      "  nonet kick-report --kick any --pushed 1 --start 0.5  # after the dribbler's own push\n"
      "  nonet kick-report --kick any --passed 2.5         # a pass that has come\n"
      "  nonet kick-report --kick kick_power --tcp         # on a server that runs, nobody else on it");
  command->callback([arguments, &exitCode] { exitCode = run(*arguments); });
}

}  // namespace nonet::app
