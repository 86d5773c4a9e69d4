#include <algorithm>
#include <atomic>
#include <csignal>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <thread>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "nonet/app/commands.h"
#include "nonet/app/console.h"
#include "nonet/app/data_folder.h"
#include "nonet/lab/match/series.h"

namespace nonet::app {
namespace {

struct SeriesArguments {
  lab::SeriesChoice choice;
  std::string a = "own";
  std::string b = "own";
  std::string out;
  std::string sequential;
  int jobs = 0;
};

std::atomic<bool> interrupted{false};  // by SIGINT or SIGTERM

lab::SideChoice sideOf(const std::string& word, const lab::SideChoice& options) {
  lab::SideChoice side = lab::sideFromWord(word);
  side.name = options.name;
  side.assignments = options.assignments;
  for (const std::string& file : options.parameterFiles)
    side.parameterFiles.push_back(std::filesystem::absolute(file).string());
  if (!side.command.empty() && (!side.assignments.empty() || !side.parameterFiles.empty()))
    throw std::runtime_error(fmt::format("{}: a foreign command takes no parameters of ours", word));
  return side;
}

/// What the user typed, for the reader of the result.
std::string commandLine() {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::string text;
  for (std::string word; std::getline(file, word, '\0');) {
    const bool plain = word.find_first_of(" '\"$&|;<>(){}*") == std::string::npos && !word.empty();
    text += (text.empty() ? "" : " ") + (plain ? word : "'" + word + "'");
  }
  return text;
}

int runSeries(SeriesArguments& arguments) {
  lab::SeriesChoice& choice = arguments.choice;
  choice.a = sideOf(arguments.a, choice.a);
  choice.b = sideOf(arguments.b, choice.b);
  if (choice.a.name == choice.b.name)
    throw std::runtime_error("the teams need different names (--a-name, --b-name)");
  if (!arguments.sequential.empty()) choice.sequential = lab::parseSequentialBounds(arguments.sequential);
  if (!choice.a.ours() || !choice.b.ours())
    throw std::runtime_error("in one process only this program can play: give own or a data folder");
  choice.date = fmt::format("{:%Y-%m-%d %H:%M}", fmt::gmtime(std::time(nullptr)));
  choice.version = NONET_VERSION;
  choice.commandLine = commandLine();
  for (lab::SideChoice* side : {&choice.a, &choice.b})
    side->fingerprint = lab::fingerprintOf(*side, dataFolder());
  if (arguments.out.empty())
    arguments.out = fmt::format("logs/series-{:%Y%m%d-%H%M%S}", fmt::gmtime(std::time(nullptr)));

  spdlog::set_level(spdlog::level::warn);  // who enters the field is no news here
  Console console;
  lab::Series series(arguments.out, choice);
  lab::writeOverlays(choice, arguments.out, dataFolder());
  const int cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  const int jobs = arguments.jobs > 0 ? arguments.jobs : cores;
  console.say(fmt::format("{} pairs, seeds {} to {}, {} games at a time, in {}", choice.pairs, choice.seed,
                          choice.seed + static_cast<std::uint64_t>(choice.pairs) - 1, jobs, arguments.out));
  if (series.played() > 0) console.say(fmt::format("resumed: {} games are there", series.played()));
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, [](int) { interrupted = true; });
  const bool complete =
      lab::playSeries(series, jobs, lab::inProcessGames(series.choice(), arguments.out, dataFolder()),
                      [&](const lab::SeriesProgress& progress) {
                        if (console.due()) console.progress(progress.line(series.choice()));
                        return !interrupted;
                      });
  console.end();
  if (!complete) {
    fmt::print("{}stopped; the same command goes on (--out {})\n", series.result().toText(series.choice()),
               arguments.out);
    return 1;
  }
  fmt::print("{}result in {}/result.json\n", series.finish().toText(series.choice()), arguments.out);
  return 0;
}

void addSideOptions(CLI::App& command, const std::string& letter, const std::string& alias,
                    lab::SideChoice& side) {
  command
      .add_option(fmt::format("--{}-set,--{}-set", letter, alias), side.assignments,
                  fmt::format("Parameters of side {}, key=value", letter))
      ->take_all();
  command
      .add_option(fmt::format("--{}-params,--{}-params", letter, alias), side.parameterFiles,
                  fmt::format("Parameter files of side {}", letter))
      ->check(CLI::ExistingFile);
  command
      .add_option(fmt::format("--{}-name", letter), side.name, fmt::format("Team name of side {}", letter))
      ->capture_default_str();
}

}  // namespace

void addSeriesCommand(CLI::App& app, int& exitCode) {
  CLI::App* command = app.add_subcommand(
      "series", "Many paired games between two sides, until it is clear which is stronger");
  auto arguments = std::make_shared<SeriesArguments>();
  lab::SeriesChoice& choice = arguments->choice;
  choice.a.name = "A";
  choice.b.name = "B";
  command->add_option("A", arguments->a, "Side A: own, or a folder with params/ and skills/")
      ->capture_default_str();
  command->add_option("B", arguments->b, "Side B, likewise")->capture_default_str();
  addSideOptions(*command, "a", "left", choice.a);
  addSideOptions(*command, "b", "right", choice.b);
  command->add_option("--pairs", choice.pairs, "Pairs of games, at most if --sprt is given")
      ->capture_default_str()
      ->check(CLI::Range(1, 100000));
  command->add_option("--minutes", choice.minutes, "Game time of one game, two halves")
      ->capture_default_str()
      ->check(CLI::Range(0.01, 1e4));
  command->add_option("--seed", choice.seed, "Seed of the first pair; each pair has the next one")
      ->capture_default_str();
  command->add_option("--players", choice.players, "Players a side")
      ->capture_default_str()
      ->check(CLI::Range(1, 11));
  command->add_option("--kick-off-wait", choice.kickOffWait, "Simulated seconds before each half")
      ->capture_default_str();
  command->add_option(
      "--sprt", arguments->sequential,
      "D0,D1: stop as soon as a sequential test tells a true goal difference per ten minutes of "
      "D0 from D1; 5 % error of each kind");
  command->add_option("--jobs", arguments->jobs, "Games at a time, 0: one per core")
      ->capture_default_str()
      ->check(CLI::Range(0, 1024));
  command->add_option("--out", arguments->out, "Folder; a series that is there already goes on");
  command->add_option("--settings", choice.settingFiles, "Files with settings of the server")
      ->check(CLI::ExistingFile);
  command->add_option("--set", choice.settingAssignments, "Settings of the server, Name=Value")->take_all();
  command->footer(
      "A pair is two games from one seed with the sides exchanged; A plays left in the first.\n"
      "Examples:\n"
      "  nonet series own ../before --pairs 50 --out logs/now-before\n"
      "  nonet series own own --b-set team.formation.stopperBehind=3 --sprt 0,0.5 --pairs 500\n"
      "  nonet series team-new/ team-old/ --minutes 4 --jobs 8\n"
      "A killed series goes on with the same command and --out, and ends in the same files.\n"
      "Exit codes: 0 complete, 1 not.");
  command->callback([arguments, &exitCode] { exitCode = runSeries(*arguments); });
}

}  // namespace nonet::app
