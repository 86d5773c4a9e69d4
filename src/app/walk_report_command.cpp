// nonet walk-report: how a parameter set walks.
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "nonet/agent/agent_setup.h"
#include "nonet/app/agent_options.h"
#include "nonet/app/commands.h"
#include "nonet/app/console.h"
#include "nonet/app/data_folder.h"
#include "nonet/app/option_checks.h"
#include "nonet/lab/common/atomic_file.h"
#include "nonet/lab/reports/walk_report.h"

namespace nonet::app {

namespace {

struct WalkReportArguments {
  agent::AgentChoice choice;
  std::string data;
  lab::WalkReportSettings settings;
  ServerChoice server;
  bool json = false;
  bool initial = false;
  std::string svgFile;
  std::string traceFile;
};

int run(WalkReportArguments arguments) {
  arguments.choice.learned = !arguments.initial;
  if (arguments.server.overTcp && arguments.settings.courses > 0)
    throw std::runtime_error("courses are walked in process only: leave out --tcp or --courses");
  lab::WalkReportSettings& settings = arguments.settings;
  settings.seed = arguments.choice.seed;
  settings.setup = lab::trialSettings(agent::makeAgentSettings(arguments.choice, dataFolder(arguments.data)));
  settings.server = arguments.server.chosen();
  if (!arguments.traceFile.empty()) {
    lab::writeAtomically(arguments.traceFile, lab::walkTraceSvg(settings.setup, Pose2(10.0, 0.0, 0.0), 1.0));
  }
  const lab::WalkReport report = measureShown(settings, lab::measureWalk);
  fmt::print("{}", arguments.json ? lab::walkReportJson(report) : lab::walkReportTable(report));
  if (!arguments.svgFile.empty()) lab::writeAtomically(arguments.svgFile, lab::walkReportSvg(report));
  return 0;
}

}  // namespace

void addWalkReportCommand(CLI::App& app, int& exitCode) {
  CLI::App* command = app.add_subcommand(
      "walk-report",
      "Measure a parameter set: speeds in 16 directions and turning, falls, confidence intervals");
  const auto arguments = std::make_shared<WalkReportArguments>();
  addAgentOptions(*command, arguments->choice, arguments->data);
  command->add_option("--trials", arguments->settings.trials, "Walks per measure")
      ->check(CLI::Range(1, 10000));
  command
      ->add_option("--courses", arguments->settings.courses,
                   "Walk so many obstacle courses of a minute as well: falls, reward, time")
      ->check(CLI::Range(0, 10000));
  command->add_flag("--initial", arguments->initial,
                    "Start from the code's own values, not params/type*.toml");
  command->add_option("--seed", arguments->choice.seed, "Seed of all trials");
  command->add_option("--threads", arguments->settings.threads, "Threads, 0 = all processors")
      ->check(threadCount());
  addServerOptions(*command, arguments->server);
  command->add_flag("--json", arguments->json, "Print JSON");
  command->add_option("--svg", arguments->svgFile, "Write a polar plot of the speeds");
  command->add_option("--trace", arguments->traceFile, "Write a plot of one second of fast walking forward");
  command->footer(
      "Examples:\n  nonet walk-report --type 3\n  nonet walk-report --type 3 --trials 3 --courses 10 --json\n"
      "  nonet walk-report --params my.toml --svg walk.svg --trace trace.svg");
  command->callback([arguments, &exitCode] { exitCode = run(*arguments); });
}

}  // namespace nonet::app
