// nonet ball-report: the ball at the feet, and the run.
#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include "nonet/agent/agent_setup.h"
#include "nonet/agent/data_folder.h"
#include "nonet/app/agent_options.h"
#include "nonet/app/commands.h"
#include "nonet/app/console.h"
#include "nonet/app/data_folder.h"
#include "nonet/app/option_checks.h"
#include "nonet/lab/reports/ball_report.h"

namespace nonet::app {

namespace {

struct BallReportArguments {
  agent::AgentChoice choice;
  lab::BallReportSettings settings;
  std::string data;
  std::string opponentData;
  std::vector<std::string> opponentParameters;
  std::string svg;
  bool json = false;
};

lab::Defence defenceOf(int backType, const std::vector<std::string>& parameterFiles,
                       const std::string& data) {
  agent::AgentChoice back;
  back.robotType = backType;
  back.parameterFiles = parameterFiles;
  agent::AgentChoice goalie = back;
  goalie.robotType = 0;
  return {agent::makeAgentSettings(goalie, data), agent::makeAgentSettings(back, data)};
}

// Opponents are as their data folder has them; in the siege they are a wall.
void addOpponents(const BallReportArguments& arguments, const std::string& data,
                  lab::BallReportSettings& settings) {
  const std::string opponentData =
      arguments.opponentData.empty()
          ? data
          : agent::dataFolder(arguments.opponentData, "--opponent-data", executablePath(), "");
  const int type = arguments.choice.robotType;
  const lab::Defence given = defenceOf(type, arguments.opponentParameters, opponentData);
  settings.opponent = given.back;
  settings.goalie = given.goalie;
  settings.wall = arguments.opponentParameters.empty()
                      ? defenceOf(type, {data + "/params/variants/wall.toml"}, opponentData)
                      : given;
}

void refuseOpponents(const BallReportArguments& arguments, const std::string& skill) {
  const std::vector<std::string> names = lab::ballSkillsWithOpponents();
  if (skill == "all" || std::ranges::find(names, skill) != names.end()) return;
  for (const auto& [option, isGiven] :
       {std::pair{"--opponent-data", !arguments.opponentData.empty()},
        std::pair{"--opponent-params", !arguments.opponentParameters.empty()}}) {
    if (!isGiven) continue;
    throw std::runtime_error(
        fmt::format("{}: only {} have opponents: leave it out, or choose one of these or all", option,
                    fmt::join(names, ", ")));
  }
}

int run(const BallReportArguments& arguments) {
  spdlog::set_level(spdlog::level::err);  // who enters the field is no news here
  lab::BallReportSettings settings = arguments.settings;
  if (!arguments.svg.empty() && settings.skill != "slalom" && settings.skill != "all")
    throw std::runtime_error("--svg draws the slalom only: leave it out, or choose --skill slalom or all");
  refuseOpponents(arguments, settings.skill);
  settings.seed = arguments.choice.seed;
  const std::string data = dataFolder(arguments.data);
  settings.agent = agent::makeAgentSettings(arguments.choice, data);
  addOpponents(arguments, data, settings);
  const lab::BallReport report = measureShown(settings, lab::measureBallSkills);
  fmt::print("{}", arguments.json ? lab::ballReportJson(report, settings) : lab::ballReportTable(report));
  if (arguments.svg.empty() || report.slaloms.empty()) return 0;
  const std::string path = arguments.svg + "slalom.svg";
  writeAndName(path, lab::slalomSvg(report.slaloms, settings));
  return 0;
}

}  // namespace

void addBallReportCommand(CLI::App& app, int& exitCode) {
  CLI::App* command = app.add_subcommand(
      "ball-report", "Measures what robots do with the ball at their feet: whole agents, seeded trials");
  const auto arguments = std::make_shared<BallReportArguments>();
  lab::BallReportSettings& settings = arguments->settings;
  addAgentOptions(*command, arguments->choice, arguments->data);
  command->add_option("--skill", settings.skill,
                      fmt::format("One of {}; or all", fmt::join(lab::ballSkillNames(), ", ")));
  command->add_option("--opponent-data", arguments->opponentData,
                      "The same for opponents; without it: that of --data, without --set");
  command
      ->add_option("--opponent-params", arguments->opponentParameters,
                   "A parameter file for opponents; given again, the later one lies over the earlier. "
                   "Without it they are a wall in the siege: params/variants/wall.toml of --data")
      ->check(CLI::ExistingFile)
      ->allow_extra_args(false);
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
