// nonet kick-report: how far and how straight the robot kicks.
#include <memory>

#include <fmt/format.h>

#include "nonet/agent/agent_setup.h"
#include "nonet/app/commands.h"
#include "nonet/app/data_folder.h"
#include "nonet/lab/reports/kick_report.h"

namespace nonet::app {

namespace {

struct KickReportArguments {
  agent::AgentChoice choice;
  lab::KickReportSettings settings;
  bool walking = false;
  bool json = false;
};

int run(const KickReportArguments& arguments) {
  lab::KickReportSettings settings = arguments.settings;
  settings.seed = arguments.choice.seed;
  if (arguments.walking) settings.from = lab::KickFrom::Walk;
  settings.setup = lab::trialSetup(agent::makeAgentConfig(arguments.choice, dataFolder()));
  const lab::KickReport report = lab::measureKicks(settings);
  fmt::print("{}", arguments.json ? lab::kickReportJson(report) : lab::kickReportTable(report));
  return 0;
}

}  // namespace

void addKickReportCommand(CLI::App& app, int& exitCode) {
  CLI::App* command = app.add_subcommand("kick-report", "Measure seeded kicks: distance, direction, falls");
  const auto arguments = std::make_shared<KickReportArguments>();
  command->add_option("--type", arguments->choice.robotType, "Robot type")->check(CLI::Range(0, 4));
  command->add_option("--params", arguments->choice.parameterFiles, "Parameter files, overlaid in this order")
      ->check(CLI::ExistingFile);
  command->add_option("--kicks", arguments->settings.kicks, "Kicks with each foot")
      ->check(CLI::Range(1, 100000));
  command->add_option("--seed", arguments->choice.seed, "Seed of all kicks");
  command->add_option("--threads", arguments->settings.threads, "Threads, 0 = all processors");
  command->add_flag("--walking", arguments->walking, "Out of slow steps instead of from the stand");
  command->add_flag("--json", arguments->json, "Print JSON");
  command->callback([arguments, &exitCode] { exitCode = run(*arguments); });
}

}  // namespace nonet::app
