#include <ctime>
#include <filesystem>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "nonet/app/commands.h"
#include "nonet/app/data_folder.h"
#include "nonet/app/series_games.h"
#include "nonet/app/series_run.h"
#include "nonet/app/team_name.h"

namespace nonet::app {
namespace {

/// A side as the options give it.
struct SideArguments {
  std::string word = "own";
  std::string binary;
  lab::SideSettings side;  // name, parameter files and assignments
};

struct SeriesArguments {
  lab::SeriesSettings settings;
  SideArguments a;
  SideArguments b;
  std::string data;
  std::string out;
  std::string sequential;
  std::vector<std::string> assignments;
  int jobs = 0;
};

lab::SideSettings sideOf(const SideArguments& arguments, const std::string& dataFolder) {
  if (!arguments.binary.empty() && arguments.word != "own")
    throw std::runtime_error(
        fmt::format("{}: give the side or an executable for it, not both", arguments.word));
  lab::SideSettings side =
      lab::sideFromWord(arguments.binary.empty() ? arguments.word : arguments.binary, dataFolder);
  side.name = arguments.side.name;
  side.assignments = arguments.side.assignments;
  side.robotTypes = arguments.side.robotTypes;
  for (const std::string& file : arguments.side.parameterFiles)
    side.parameterFiles.push_back(std::filesystem::absolute(file).string());
  if (!side.nonet() && side.hasOverlays())
    throw std::runtime_error(
        fmt::format("{}: a foreign command takes no parameters or robot types of ours", arguments.word));
  return side;
}

/// To the server, or to both sides. What a side sets itself counts.
void assign(SeriesArguments& arguments) {
  std::vector<std::string> ofBoth;
  for (const std::string& assignment : arguments.assignments) {
    (lab::namesParameter(assignment) ? ofBoth : arguments.settings.settingAssignments).push_back(assignment);
  }
  for (lab::SideSettings* side : {&arguments.a.side, &arguments.b.side})
    side->assignments.insert(side->assignments.begin(), ofBoth.begin(), ofBoth.end());
}

int runSeries(SeriesArguments& arguments) {
  assign(arguments);
  lab::SeriesSettings& settings = arguments.settings;
  const std::string data = std::filesystem::absolute(dataFolder(arguments.data)).string();
  settings.a = sideOf(arguments.a, data);
  settings.b = sideOf(arguments.b, data);
  if (settings.a.name == settings.b.name)
    throw std::runtime_error("the teams need different names (--a-name, --b-name)");
  for (const lab::SideSettings* side : {&settings.a, &settings.b}) {
    checkTeamName(side->name);
    lab::checkSide(*side, data);
    lab::checkRobotTypes(side->robotTypes, settings.players);
  }
  if (!arguments.sequential.empty()) settings.sequential = lab::parseSequentialBounds(arguments.sequential);
  settings.place = lab::placeFor(settings);
  (void)serverPlace(settings.place);  // a word that is no place
  lab::checkPlace(settings);
  settings.commandLine = commandLine();
  if (arguments.out.empty())
    arguments.out = fmt::format("logs/series-{:%Y%m%d-%H%M%S}", fmt::gmtime(std::time(nullptr)));

  Console console;
  const SeriesRun run = playSeries(settings, arguments.out, arguments.jobs, data, console, "");
  const lab::Series& series = *run.series;
  if (!run.complete) {
    fmt::print("{}stopped; the same command goes on (--out {})\n", series.result().toText(series.settings()),
               arguments.out);
    return 1;
  }
  fmt::print("{}result in {}/result.json\n", run.result.toText(series.settings()), arguments.out);
  return 0;
}

void addSideOptions(CLI::App& command, const std::string& letter, const std::string& alias,
                    SideArguments& arguments) {
  lab::SideSettings& side = arguments.side;
  command
      .add_option(fmt::format("--{}-binary,--{}-binary", letter, alias), arguments.binary,
                  fmt::format("Another executable of Nonet for side {}, of an older commit say", letter))
      ->check(CLI::ExistingFile);
  command
      .add_option(fmt::format("--{}-set,--{}-set", letter, alias), side.assignments,
                  fmt::format("Parameters of side {}, key=value", letter))
      ->take_all();
  command
      .add_option(fmt::format("--{}-params,--{}-params", letter, alias), side.parameterFiles,
                  fmt::format("Parameter files of side {}", letter))
      ->check(CLI::ExistingFile);
  command
      .add_option(fmt::format("--{}-types,--{}-types", letter, alias), side.robotTypes,
                  fmt::format("Robot types of side {} from number 1 on, such as 0,2,2,2,2,2,2,2,4", letter))
      ->delimiter(',')
      ->check(CLI::Range(0, 4));
  command.add_option(fmt::format("--{}-name", letter), side.name,
                     fmt::format("Team name of side {}", letter));
}

}  // namespace

void addSeriesCommand(CLI::App& app, int& exitCode) {
  CLI::App* command = app.add_subcommand(
      "series", "Many paired games between two sides, until it is clear which is stronger");
  auto arguments = std::make_shared<SeriesArguments>();
  lab::SeriesSettings& settings = arguments->settings;
  settings.place.clear();
  arguments->a.side.name = "A";
  arguments->b.side.name = "B";
  command->add_option("A", arguments->a.word,
                      "Side A: own, a variant (params/variants/), a folder with params/ and skills/, an "
                      "executable of Nonet, or a shell command with {port} in it that starts agents");
  command->add_option("B", arguments->b.word, "Side B, likewise");
  addSideOptions(*command, "a", "left", arguments->a);
  addSideOptions(*command, "b", "right", arguments->b);
  command->add_option(
      "--where", settings.place,
      "process: all in this process (the default if it can be); tcp: the embedded server in lock-step, every "
      "agent a process; realtime: the same by the clock, for agents that do not send (syn); or "
      "HOST:PORT:MONITORPORT of a server that runs");
  command->add_option(
      "--server-command", settings.serverCommand,
      "Shell command that starts that server before each game: {port} {monitor} {seed} {half} "
      "(seconds of a half)");
  command->add_option("--data", arguments->data, "Folder with params/ and skills/ of this program's sides")
      ->check(CLI::ExistingDirectory);
  command->add_option("--pairs", settings.pairs, "Pairs of games, at most if --sprt is given")
      ->check(CLI::Range(1, 100000));
  command->add_option("--minutes", settings.minutes, "Game time of one game, two halves")
      ->check(CLI::Range(0.01, 1e4));
  command->add_option("--seed", settings.seed, "Seed of the first pair; each pair has the next one");
  command->add_option("--players", settings.players, "Players a side")->check(CLI::Range(1, 11));
  command->add_option("--kick-off-wait", settings.kickOffWait, "Simulated seconds before each half")
      ->check(CLI::Range(0.0, 1e4));
  command->add_option(
      "--sprt", arguments->sequential,
      "D0,D1: stop as soon as a sequential test tells a true goal difference per ten minutes of "
      "D0 from D1; 5 % error of each kind");
  command->add_option("--jobs", arguments->jobs, "Games at a time, 0: one per core")
      ->check(CLI::Range(0, 1024));
  command->add_flag(
      "--monitor-logs", settings.monitorLogs,
      "Keep the monitor stream of each game for `nonet view`, game-PAIR-GAME.mon in the folder");
  command->add_option("--out", arguments->out, "Folder; a series that is there already goes on");
  command->add_option("--settings", settings.settingFiles, "Files with settings of the server")
      ->check(CLI::ExistingFile);
  command
      ->add_option("--set", arguments->assignments,
                   "One value, name=value: a setting of the server (QuickSolver=true), or with a dot a "
                   "parameter of both sides (team.ball.kick=false)")
      ->allow_extra_args(false);
  command->footer(
      "A pair is two games from one seed with the sides exchanged; A plays left in the first.\n"
      "Examples:\n"
      "  nonet series own wall --pairs 10 --minutes 4\n"
      "  nonet series own own --b-set team.formation.stopperBehind=3 --sprt 0,0.5 --pairs 500\n"
      "  nonet series own own --a-types 0,3,3,3,3,3,3,3,4 --pairs 20          other robot types\n"
      "  nonet series own ../before --pairs 50 --out logs/now-before          other data, same program\n"
      "  nonet series own --b-binary ../before/build/release/nonet            an older program\n"
      "  nonet series own 'cd ~/others && ./start.sh {host} {port} {team}' --where realtime --jobs 1\n"
      "  nonet series own wall --where localhost:3100:3200                    on a server that runs\n"
      "In a shell command {host} {port} {monitor} {team} {players} {seed} {folder} (of this game, for logs) "
      "are "
      "filled in. What it starts is stopped after the game.\n"
      "A killed series goes on with the same command and --out, and ends in the same files.\n"
      "Exit codes: 0 complete, 1 not.");
  command->callback([arguments, &exitCode] { exitCode = runSeries(*arguments); });
}

}  // namespace nonet::app
