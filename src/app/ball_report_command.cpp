// nonet ball-report: the ball at the feet, and the run.
#include <memory>
#include <stdexcept>
#include <string>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "nonet/agent/agent_setup.h"
#include "nonet/agent/data_folder.h"
#include "nonet/app/agent_options.h"
#include "nonet/app/commands.h"
#include "nonet/app/console.h"
#include "nonet/app/data_folder.h"
#include "nonet/app/option_checks.h"
#include "nonet/lab/common/atomic_file.h"
#include "nonet/lab/reports/ball_report.h"

namespace nonet::app {

namespace {

struct BallReportArguments {
  agent::AgentChoice choice;
  lab::BallReportSettings settings;
  std::string data;
  std::string opponentData;
  std::string svg;
  bool json = false;
};

bool hasOpponents(const std::string& skill) {
  return skill == "all" || skill == "duel" || skill == "attack" || skill == "scrum" || skill == "loose";
}

int run(const BallReportArguments& arguments) {
  spdlog::set_level(spdlog::level::err);  // who enters the field is no news here
  lab::BallReportSettings settings = arguments.settings;
  if (!arguments.svg.empty() && settings.skill != "slalom" && settings.skill != "all")
    throw std::runtime_error("--svg draws the slalom only: leave it out, or choose --skill slalom or all");
  if (!arguments.opponentData.empty() && !hasOpponents(settings.skill))
    throw std::runtime_error(
        "--opponent-data: only duel, attack, scrum and loose have opponents: leave it out, or choose one of "
        "these or all");
  settings.seed = arguments.choice.seed;
  const std::string data = dataFolder(arguments.data);
  settings.agent = agent::makeAgentSettings(arguments.choice, data);
  agent::AgentChoice opponent;
  opponent.robotType = arguments.choice.robotType;
  const std::string opponentData =
      arguments.opponentData.empty()
          ? data
          : agent::dataFolder(arguments.opponentData, "--opponent-data", executablePath(), "");
  settings.opponent = agent::makeAgentSettings(opponent, opponentData);
  agent::AgentChoice goalie;
  goalie.robotType = 0;
  settings.goalie = agent::makeAgentSettings(goalie, opponentData);
  Console console(stderr);
  settings.progress = console.trials();
  const lab::BallReport report = lab::measureBallSkills(settings);
  console.end();
  fmt::print("{}", arguments.json ? lab::ballReportJson(report, settings) : lab::ballReportTable(report));
  if (arguments.svg.empty() || report.slaloms.empty()) return 0;
  const std::string path = arguments.svg + "slalom.svg";
  lab::writeAtomically(path, lab::slalomSvg(report.slaloms, settings));
  fmt::print(stderr, "{}\n", path);
  return 0;
}

}  // namespace

void addBallReportCommand(CLI::App& app, int& exitCode) {
  CLI::App* command = app.add_subcommand("ball-report",
                                         "Measure seeded ball skills: approach, dribble, slalom, drive, "
                                         "duel, attack, scrum, loose ball, receive, run with its stop");
  const auto arguments = std::make_shared<BallReportArguments>();
  lab::BallReportSettings& settings = arguments->settings;
  addAgentOptions(*command, arguments->choice, arguments->data);
  command->add_option("--skill", settings.skill, "One of them, or all");
  command->add_option("--opponent-data", arguments->opponentData,
                      "The same for the opponents in duel, attack, scrum and loose; without it: that of "
                      "--data, without --set");
  command->add_option("--trials", settings.trials, "Trials of each skill")->check(CLI::Range(1, 100000));
  command->add_option("--seed", arguments->choice.seed, "Seed of all trials");
  command->add_option("--threads", settings.threads, "Threads, 0 = all processors")->check(threadCount());
  command->add_flag("--quick", settings.quickSolver, "Quick stepper instead of the exact one");
  command->add_option(
      "--svg", arguments->svg,
      "Draw the balls' ways in the slalom to a file with this beginning: ways_ gives ways_slalom.svg");
  command->add_flag("--json", arguments->json, "Print JSON");
  command->footer(
      "Examples:\n  nonet ball-report --type 4 --json\n  nonet ball-report --skill slalom --trials 20 --svg "
      "ways_\n  nonet ball-report --skill duel --set team.dribble.speed=1.2");
  command->callback([arguments, &exitCode] { exitCode = run(*arguments); });
}

}  // namespace nonet::app
