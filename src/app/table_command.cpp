#include <ctime>
#include <filesystem>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "nonet/app/commands.h"
#include "nonet/app/console.h"
#include "nonet/app/data_folder.h"
#include "nonet/app/series_games.h"
#include "nonet/app/series_run.h"
#include "nonet/app/team_name.h"
#include "nonet/app/version.h"
#include "nonet/lab/common/atomic_file.h"
#include "nonet/lab/common/folder_lock.h"
#include "nonet/lab/match/table.h"

namespace nonet::app {
namespace {

struct TableArguments {
  std::string file;
  std::string out;
  std::string data;
  std::optional<int> pairs;
  std::optional<double> minutes;
  int jobs = 0;
  bool json = false;
};

void write(const lab::TableSettings& table, const std::vector<lab::TableEntry>& entries,
           const std::string& folder) {
  lab::writeAtomically(folder + "/table.json", lab::tableJson(table, entries).dump(1) + "\n");
  lab::writeAtomically(folder + "/table.txt", lab::tableText(table, entries));
}

int runTable(TableArguments& arguments) {
  const std::string data = std::filesystem::absolute(dataFolder(arguments.data)).string();
  lab::TableSettings table = lab::readTable(arguments.file, data);
  if (arguments.pairs) table.games.pairs = *arguments.pairs;
  if (arguments.minutes) table.games.minutes = *arguments.minutes;
  for (const lab::SideSettings& side : table.sides) {
    checkTeamName(side.name);
    try {
      lab::checkSide(side, data);
      lab::checkRobotTypes(side.robotTypes, table.games.players);
    } catch (const std::exception& error) {
      throw std::runtime_error(fmt::format("{}: side '{}': {}", arguments.file, side.name, error.what()));
    }
  }
  std::vector<lab::TableEntry> entries = lab::tableEntries(table);
  for (const lab::TableEntry& entry : entries) {
    const lab::SeriesSettings settings = lab::seriesOf(table, entry);
    (void)serverPlace(settings.place);  // a word that is no place
    lab::checkPlace(settings);
  }
  table.games.date = fmt::format("{:%Y-%m-%d %H:%M}", fmt::gmtime(std::time(nullptr)));
  table.games.version = versionText();
  table.games.commandLine = commandLine();
  if (arguments.out.empty())
    arguments.out = "logs/" + std::filesystem::path(arguments.file).stem().string() + "-table";
  lab::makeFolder(arguments.out);

  Console console(arguments.json ? stderr : stdout);
  const std::vector<std::string> folders = lab::entryFolders(table, entries);
  bool complete = true;
  for (std::size_t i = 0; i < entries.size() && complete; ++i) {
    const lab::SeriesSettings settings = lab::seriesOf(table, entries[i]);
    const SeriesRun run = playSeries(
        settings, arguments.out + "/" + folders[i], arguments.jobs, data, console,
        fmt::format("{} - {} ({} of {}): ", settings.a.name, settings.b.name, i + 1, entries.size()));
    entries[i].result = run.result;
    complete = run.complete;
    write(table, entries, arguments.out);
  }
  if (arguments.json)
    fmt::print("{}\n", lab::tableJson(table, entries).dump());
  else
    fmt::print("{}", lab::tableText(table, entries));
  const char* end = complete ? "table in {0}/table.txt and {0}/table.json\n"
                             : "stopped; the same command goes on (--out {0})\n";
  fmt::print(stderr, fmt::runtime(end), arguments.out);
  return complete ? 0 : 1;
}

}  // namespace

void addTableCommand(CLI::App& app, int& exitCode) {
  CLI::App* command = app.add_subcommand(
      "table", "Teams of a file against each other, or one against all, as a table of goal differences");
  auto arguments = std::make_shared<TableArguments>();
  command->add_option("FILE", arguments->file, "What is played (TOML)")->required()->check(CLI::ExistingFile);
  command->add_option("--out", arguments->out,
                      "Folder with a series for each entry; a table that is there already goes on");
  command->add_option("--pairs", arguments->pairs, "So many pairs of games instead of the file's")
      ->check(CLI::Range(1, 100000));
  command->add_option("--minutes", arguments->minutes, "Games of so many minutes instead of the file's")
      ->check(CLI::Range(0.01, 10000.0));
  command->add_option("--jobs", arguments->jobs, "Games at a time, 0: one per core")
      ->check(CLI::Range(0, 1024));
  command->add_flag("--json", arguments->json, "Print JSON instead of text");
  command->add_option("--data", arguments->data, "Folder with params/ and skills/ of this program's sides")
      ->check(CLI::ExistingDirectory);
  command->footer(
      "Examples:\n"
      "  nonet table params/tables/walks.toml --pairs 2 --minutes 2 --out logs/quick-walks\n"
      "  nonet table params/tables/formations.toml     whole games: more than a day on two cores\n"
      "The file:\n"
      "  against = \"full\"          without it everybody plays everybody\n"
      "  pairs = 50\n"
      "  minutes = 10\n"
      "  sprt = [0.0, 0.5]         stops an entry early; may be left out\n"
      "  [[side]]\n"
      "  name = \"full\"\n"
      "  side = \"own\"              as on the command line of nonet series\n"
      "  [[side]]\n"
      "  name = \"boxes\"            a variant of params/variants/\n"
      "  [[side]]\n"
      "  name = \"low-line\"\n"
      "  side = \"own\"\n"
      "  set = [\"team.formation.stopperBehind=3\"]\n"
      "All keys: docs/how-to.md, Compare many teams. Exit codes: 0 complete, 1 not.");
  command->callback([arguments, &exitCode] { exitCode = runTable(*arguments); });
}

}  // namespace nonet::app
