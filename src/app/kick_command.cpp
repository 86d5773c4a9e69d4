// nonet kick fit: a kick's curve within what the robot can do.
#include <memory>
#include <string>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "nonet/agent/agent_setup.h"
#include "nonet/app/agent_options.h"
#include "nonet/app/commands.h"
#include "nonet/app/data_folder.h"
#include "nonet/lab/common/atomic_file.h"
#include "nonet/lab/optimize/kick_fit.h"

namespace nonet::app {

namespace {

struct KickFitArguments {
  agent::AgentChoice choice;
  lab::KickFitSettings settings;
  std::string data;
  std::string out;
};

int fit(const KickFitArguments& arguments) {
  spdlog::set_level(spdlog::level::warn);
  lab::KickFitSettings settings = arguments.settings;
  settings.agent = agent::makeAgentSettings(arguments.choice, dataFolder(arguments.data));
  const lab::KickFit result = lab::fitKick(settings);
  fmt::print("{}", lab::kickFitTable(result));
  if (arguments.out.empty()) {
    fmt::print("\n{}", lab::kickFitToml(result));
  } else {
    lab::writeAtomically(arguments.out, lab::kickFitToml(result));
    fmt::print(stderr, "{}\n", arguments.out);
  }
  return result.holds ? 0 : 1;
}

}  // namespace

void addKickCommand(CLI::App& app, int& exitCode) {
  CLI::App* command = app.add_subcommand("kick", "Tools for kicks along curves (skills/README.md)");
  command->require_subcommand(1);
  const auto arguments = std::make_shared<KickFitArguments>();
  CLI::App* fitCommand = command->add_subcommand(
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
  fitCommand->add_option("--out", arguments->out,
                         "Write the parameters into this file; otherwise they are printed");
  fitCommand->footer(
      "Begins at the values of the skill file and params/ (with --params and --set on top); moves those with "
      "a range that\nmove the curve. Exit code 1: no curve within the limits was found.\n"
      "Examples:\n  nonet kick fit kick_heel --type 2 --out logs/heel.toml\n"
      "  nonet kick-report --type 2 --kick kick_heel --params logs/heel.toml\n"
      "  nonet optimize swing_heel --type 2 --quick --params logs/heel.toml --out runs/heel2");
  fitCommand->callback([arguments, &exitCode] { exitCode = fit(*arguments); });
  command->footer("Example:\n  nonet kick fit kick_heel --type 2 --out logs/heel.toml");
}

}  // namespace nonet::app
