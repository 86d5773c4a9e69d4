#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <set>
#include <stdexcept>

#include <fmt/format.h>

#include "nonet/agent/trace.h"
#include "nonet/app/commands.h"
#include "nonet/app/data_folder.h"
#include "nonet/lab/common/folder_lock.h"
#include "nonet/lab/reports/localization_report.h"
#include "nonet/lab/reports/replay.h"
#include "nonet/protocol/log_file.h"

namespace nonet::app {
namespace {

struct ReplayArguments {
  std::vector<std::string> files;
  lab::ReplaySettings settings;
  bool json = false;
  bool localization = false;
  std::string maps = "logs/maps";
  std::set<std::string> mapsWritten;  // in this call
  bool trace = false;
  bool csv = false;
  double from = 0.0;  // s of the game
  double to = std::numeric_limits<double>::infinity();
};

void printTrace(const agent::Session& session, const ReplayArguments& arguments) {
  const double time = session.agent().world().game.time;
  if (time < arguments.from || time > arguments.to) return;
  const nlohmann::ordered_json trace = agent::traceOf(session.agent());
  fmt::print("{}\n", arguments.csv ? agent::traceCsv(trace) : trace.dump());
}

/// "logs/3.zst" -> "FOLDER/3.zst.svg"; a further log of that name -> "FOLDER/3.zst-2.svg".
std::string freeMap(const std::string& log, ReplayArguments& arguments) {
  const std::filesystem::path name = std::filesystem::path(log).filename();
  const std::string plain = (std::filesystem::path(arguments.maps) / name).string();
  std::string path = plain + ".svg";
  for (int i = 2; !arguments.mapsWritten.insert(path).second; ++i) path = fmt::format("{}-{}.svg", plain, i);
  return path;
}

std::string writeMap(const lab::LocalizationReport& report, const std::string& log,
                     ReplayArguments& arguments) {
  lab::makeFolder(arguments.maps);
  std::string path = freeMap(log, arguments);
  std::ofstream file(path);
  file << report.toSvg();
  if (!file.flush()) throw std::runtime_error("cannot write " + path);
  return path;
}

void printLocalization(const lab::LocalizationReport& report, const std::string& file,
                       ReplayArguments& arguments) {
  const bool known = report.summary().frames > 0;
  const std::string map = known ? writeMap(report, file, arguments) : "";
  if (arguments.json) {
    nlohmann::ordered_json json = {{"file", file}};
    json.update(report.toJson());
    json["map"] = map;
    fmt::print("{}\n", json.dump());
    return;
  }
  fmt::print("{}: {}", file, report.toText());
  if (known) fmt::print("  map in {}\n", map);
}

// Exit codes; of several files the worst.
constexpr int kDifference = 1;
constexpr int kUnreadable = 2;
constexpr int kNoLog = 3;

/// The exit code for this file.
int replayOne(const std::string& file, ReplayArguments& arguments, lab::LocalizationReport& all) {
  lab::LocalizationReport localization;
  if (arguments.localization) {
    arguments.settings.observer = [&](const agent::Session& session) {
      localization.add(session.percept(), session.agent().world());
      all.add(session.percept(), session.agent().world());
    };
    arguments.settings.truthObserver = [&](std::string_view truth) {
      localization.sharpen(truth);
      all.sharpen(truth);
    };
  }
  if (arguments.trace) {
    if (arguments.csv) fmt::print("{}\n", agent::traceCsvHeader());
    arguments.settings.observer = [&](const agent::Session& session) { printTrace(session, arguments); };
  }
  const lab::ReplayReport report = lab::replay(file, arguments.settings);
  if (arguments.localization) {
    printLocalization(localization, file, arguments);
  } else {
    // A trace has the standard output for itself.
    fmt::print(arguments.trace ? stderr : stdout, "{}",
               arguments.json ? report.toJson().dump() + "\n" : report.toText());
  }
  if (!report.sound) {
    fmt::print(stderr, "nonet replay: {}\n", report.problem);
    return kNoLog;
  }
  return report.clean() ? 0 : kDifference;
}

int runReplay(ReplayArguments& arguments) {
  arguments.settings.dataFolder = dataFolder(arguments.settings.dataFolder);
  lab::LocalizationReport all;
  int exitCode = 0;
  for (const std::string& file : arguments.files) {
    try {
      exitCode = std::max(exitCode, replayOne(file, arguments, all));
    } catch (const protocol::LogError& error) {
      fmt::print(stderr, "nonet replay: {}\n", error.what());
      exitCode = std::max(exitCode, kUnreadable);
    }
  }
  if (arguments.localization && !arguments.json && arguments.files.size() > 1) {
    fmt::print("all {} files: {}", arguments.files.size(), all.toText());
  }
  return exitCode;
}

}  // namespace

void addReplayCommand(CLI::App& app, int& exitCode) {
  CLI::App* command = app.add_subcommand("replay", "Runs the agent over recorded logs");
  auto arguments = std::make_shared<ReplayArguments>();
  command->add_option("files", arguments->files, "Logs: our own, or foreign ones, plain, gzip or zstd")
      ->required();
  command->add_flag("--json", arguments->json, "One JSON object per file and line");
  CLI::Option* localization = command->add_flag(
      "--localization", arguments->localization,
      "Errors of the believed pose against mypos and myorien in the log, every vision message "
      "counted, and a map of both tracks");
  command->add_option("--maps", arguments->maps, "With --localization: folder for the maps (SVG)")
      ->needs(localization);
  CLI::Option* trace =
      command->add_flag("--trace", arguments->trace,
                        "What the agent believed and wanted, one JSON object per cycle; the report goes to "
                        "the standard error");
  trace->excludes(localization);
  command->add_flag("--csv", arguments->csv, "With --trace: the main values as a table")->needs(trace);
  command->add_option("--from", arguments->from, "With --trace: from this time of the game on, s")
      ->needs(trace);
  command->add_option("--to", arguments->to, "With --trace: up to this time of the game, s")->needs(trace);
  lab::ReplaySettings& settings = arguments->settings;
  command->add_option("--unum", settings.unum, "Foreign logs: the robot's number, if the log does not tell");
  command->add_option("--team", settings.team, "Foreign logs: its team");
  command->add_option("--type", settings.robotType, "Foreign logs: its type")->check(CLI::Range(0, 4));
  command
      ->add_option("--params", settings.parameterFiles,
                   "A parameter file over those of the type (foreign logs) or of the header; given again, "
                   "the later one lies over the earlier")
      ->allow_extra_args(false)
      ->check(CLI::ExistingFile);
  command
      ->add_option("--set", settings.assignments,
                   "One parameter of the agent, name=value, for example world.useLines=0; set last")
      ->allow_extra_args(false);
  command->add_option("--data", settings.dataFolder, "Folder with params/ and skills/")
      ->check(CLI::ExistingDirectory);
  command->footer(
      "Examples:\n"
      "  nonet replay logs/*.zst\n"
      "  nonet replay --trace --from 100 --to 110 --csv logs/Nonet_5.zst > trace.csv\n"
      "  nonet replay --localization tests/data/replay/*.gz\n"
      "Our own logs hold their parameters and seed: the answers must come out byte for byte as recorded.\n"
      "Exit codes: 0 all well, also if the last line is torn, 1 a difference or an unknown token, 2 a file "
      "cannot "
      "be read,\n3 a file is damaged or no log of an agent; of several files the highest.");
  command->callback([arguments, &exitCode] { exitCode = runReplay(*arguments); });
}

}  // namespace nonet::app
