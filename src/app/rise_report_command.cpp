// nonet rise-report: how reliably and how fast the robot gets up.
#include <memory>

#include <fmt/format.h>

#include "nonet/agent/agent_setup.h"
#include "nonet/app/agent_options.h"
#include "nonet/app/commands.h"
#include "nonet/app/console.h"
#include "nonet/app/data_folder.h"
#include "nonet/app/option_checks.h"
#include "nonet/lab/reports/rise_report.h"

namespace nonet::app {

namespace {

struct RiseReportArguments {
  agent::AgentChoice choice;
  std::string data;
  lab::RiseReportSettings settings;
  bool json = false;
};

int run(const RiseReportArguments& arguments) {
  lab::RiseReportSettings settings = arguments.settings;
  settings.seed = arguments.choice.seed;
  settings.setup = lab::trialSettings(agent::makeAgentSettings(arguments.choice, dataFolder(arguments.data)));
  const lab::RiseReport report = measureShown(settings, lab::measureRising);
  fmt::print("{}", arguments.json ? lab::riseReportJson(report) : lab::riseReportTable(report));
  return 0;
}

}  // namespace

void addRiseReportCommand(CLI::App& app, int& exitCode) {
  CLI::App* command = app.add_subcommand(
      "rise-report", "Measure rising from seeded falls to the front, the back and the side");
  const auto arguments = std::make_shared<RiseReportArguments>();
  addAgentOptions(*command, arguments->choice, arguments->data);
  command->add_option("--falls", arguments->settings.falls, "Falls of each kind")
      ->check(CLI::Range(1, 100000));
  command->add_option("--seed", arguments->choice.seed, "Seed of all falls");
  command->add_option("--threads", arguments->settings.threads, "Threads, 0 = all processors")
      ->check(threadCount());
  command->add_flag("--json", arguments->json, "Print JSON");
  command->footer(
      "Examples:\n  nonet rise-report --type 3\n  nonet rise-report --params my.toml --falls 20 --json");
  command->callback([arguments, &exitCode] { exitCode = run(*arguments); });
}

}  // namespace nonet::app
