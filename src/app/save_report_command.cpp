// nonet save-report: how many shots the goalie saves.
#include <memory>
#include <string>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "nonet/agent/agent_setup.h"
#include "nonet/app/agent_options.h"
#include "nonet/app/commands.h"
#include "nonet/app/console.h"
#include "nonet/app/data_folder.h"
#include "nonet/app/option_checks.h"
#include "nonet/lab/reports/save_report.h"

namespace nonet::app {

namespace {

struct SaveReportArguments {
  agent::AgentChoice choice;
  lab::SaveReportSettings settings;
  std::string data;
  std::string svg;
  bool json = false;
};

int run(const SaveReportArguments& arguments) {
  spdlog::set_level(spdlog::level::warn);  // who enters the field is no news here
  lab::SaveReportSettings settings = arguments.settings;
  settings.seed = arguments.choice.seed;
  settings.goalie = agent::makeAgentSettings(arguments.choice, dataFolder(arguments.data));
  const lab::SaveReport report = measureShown(settings, lab::measureSaves);
  fmt::print("{}", arguments.json ? lab::saveReportJson(report, settings) : lab::saveReportTable(report));
  if (arguments.svg.empty()) return 0;
  writeAndName(arguments.svg, lab::saveReportSvg(report, settings));
  return 0;
}

}  // namespace

void addSaveReportCommand(CLI::App& app, int& exitCode) {
  CLI::App* command = app.add_subcommand(
      "save-report", "Measure the goalie on seeded shots that would be goals: rolling and flying");
  const auto arguments = std::make_shared<SaveReportArguments>();
  lab::SaveReportSettings& settings = arguments->settings;
  addAgentOptions(*command, arguments->choice, arguments->data);
  command->add_option("--trials", settings.trials, "Shots of each kind")->check(CLI::Range(1, 100000));
  command
      ->add_option("--challenge", settings.challenge,
                   "Instead: so many rounds of the same twelve shots, drawn from the seed")
      ->check(CLI::Range(1, 10000));
  command->add_option("--seed", arguments->choice.seed, "Seed of all shots");
  command->add_option("--threads", settings.threads, "Threads, 0 = all processors")->check(threadCount());
  command->add_flag("--quick", settings.quickSolver, "Physics: the quick solver");
  command->add_option("--svg", arguments->svg, "Draw the shots into this file");
  command->add_flag("--json", arguments->json, "Print JSON");
  command->footer(
      "Examples:\n  nonet save-report --type 0\n  nonet save-report --type 4 --trials 100 --json\n"
      "  nonet save-report --challenge 10 --seed 7 --svg shots.svg");
  command->callback([arguments, &exitCode] { exitCode = run(*arguments); });
}

}  // namespace nonet::app
