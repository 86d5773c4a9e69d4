// nonet kick fit: a kick's curve within what the robot can do. nonet kick straighten: the ball goes where it
// should.
#include <memory>
#include <string>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "nonet/agent/agent_setup.h"
#include "nonet/app/agent_options.h"
#include "nonet/app/commands.h"
#include "nonet/app/console.h"
#include "nonet/app/data_folder.h"
#include "nonet/app/kick_options.h"
#include "nonet/lab/optimize/kick_fit.h"
#include "nonet/lab/reports/kick_straighten.h"

namespace nonet::app {

namespace {

struct KickFitArguments {
  agent::AgentChoice choice;
  lab::KickFitSettings settings;
  std::string data;
  std::string out;
};

void addOut(CLI::App& command, std::string& out) {
  command.add_option("--out", out, "Write the parameters into this file; otherwise they are printed");
}

// Into the file, or to the reader.
void give(const std::string& toml, const std::string& out) {
  if (out.empty()) {
    fmt::print("\n{}", toml);
    return;
  }
  writeAndName(out, toml);
}

int fit(const KickFitArguments& arguments) {
  spdlog::set_level(spdlog::level::warn);
  lab::KickFitSettings settings = arguments.settings;
  settings.agent = agent::makeAgentSettings(arguments.choice, dataFolder(arguments.data));
  const lab::KickFit result = lab::fitKick(settings);
  fmt::print("{}", lab::kickFitTable(result));
  give(lab::kickFitToml(result), arguments.out);
  return result.holds ? 0 : 1;
}

struct StraightenArguments {
  agent::AgentChoice choice;
  lab::KickReportSettings settings;
  std::string data;
  std::string out;
};

int straighten(const StraightenArguments& arguments) {
  spdlog::set_level(spdlog::level::warn);
  lab::KickReportSettings settings = arguments.settings;
  settings.seed = arguments.choice.seed;
  settings.agent = agent::makeAgentSettings(arguments.choice, dataFolder(arguments.data));
  const lab::StraightenedKick result = measureShown(settings, lab::straightenKick);
  fmt::print("{}", lab::straightenedTable(result));
  give(lab::straightenedToml(result), arguments.out);
  return result.better ? 0 : 1;
}

void addFitCommand(CLI::App& command, int& exitCode) {
  const auto arguments = std::make_shared<KickFitArguments>();
  CLI::App* fitCommand = command.add_subcommand(
      "fit",
      "Fit a kick's curve through the ball to joint, speed, reach and balance limits, with the fastest foot "
      "at contact");
  fitCommand->add_option("kick", arguments->settings.kick, "Name of a kick with a curve from ball")
      ->required();
  addAgentOptions(*fitCommand, arguments->choice, arguments->data);
  fitCommand->add_option("--iterations", arguments->settings.iterations, "Steps of the solver, a round")
      ->check(CLI::Range(1, 1000));
  fitCommand
      ->add_option("--starts", arguments->settings.starts,
                   "From how many places around those values the solver begins")
      ->check(CLI::Range(1, 1000));
  fitCommand->add_option("--seed", arguments->choice.seed, "Seed of these places");
  addOut(*fitCommand, arguments->out);
  fitCommand->footer(
      "Begins at the values of the skill file and params/ (with --params and --set on top); moves those with "
      "a range that\nmove the curve. Exit code 1: no curve within the limits was found.\n"
      "Examples:\n  nonet kick fit kick_heel --type 2 --out logs/heel.toml\n"
      "  nonet kick-report --type 2 --kick kick_heel --params logs/heel.toml\n"
      "  nonet optimize swing_heel --type 2 --quick --params logs/heel.toml --out runs/heel2");
  fitCommand->callback([arguments, &exitCode] { exitCode = fit(*arguments); });
}

void addStraightenCommand(CLI::App& command, int& exitCode) {
  const auto arguments = std::make_shared<StraightenArguments>();
  lab::KickReportSettings& settings = arguments->settings;
  settings.trials = 200;
  settings.start = 1.0;
  settings.rolling = 0.3;
  CLI::App* straightenCommand = command.add_subcommand(
      "straighten", "Turn a kick's foot so that the ball goes where it should, whatever the steps before");
  straightenCommand->add_option("kick", settings.kick, "Name of a kick with a parameter 'yaw' or 'veer'")
      ->required();
  addAgentOptions(*straightenCommand, arguments->choice, arguments->data);
  straightenCommand->add_option("--trials", settings.trials, "Kicks that are measured, each of seven times")
      ->check(CLI::Range(20, 100000));
  addKickOptions(*straightenCommand, settings);
  straightenCommand->add_option("--seed", arguments->choice.seed, "Seed; the last kicks have the next one");
  addOut(*straightenCommand, arguments->out);
  straightenCommand->footer(
      "The ball's direction follows the pace of the last steps and where the ball lies; a foot that turns "
      "with them undoes it.\nExit code 1: the kick is no better for it.\n"
      "Examples:\n  nonet kick straighten kick_power --type 2 --out logs/straight.toml\n"
      "  nonet kick-report --type 2 --kick kick_power --params logs/straight.toml\n"
      "  nonet optimize aimed_power --type 2 --accept logs/straight.toml --trials 40 --out "
      "params/type2.toml");
  straightenCommand->callback([arguments, &exitCode] { exitCode = straighten(*arguments); });
}

}  // namespace

void addKickCommand(CLI::App& app, int& exitCode) {
  CLI::App* command = app.add_subcommand("kick", "Tools for kicks (skills/README.md)");
  command->require_subcommand(1);
  addFitCommand(*command, exitCode);
  addStraightenCommand(*command, exitCode);
  command->footer(
      "Examples:\n  nonet kick fit kick_heel --type 2 --out logs/heel.toml\n"
      "  nonet kick straighten kick_power --type 2 --out logs/straight.toml");
}

}  // namespace nonet::app
