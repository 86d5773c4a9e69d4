#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "nonet/agent/trace.h"
#include "nonet/app/commands.h"
#include "nonet/app/data_folder.h"
#include "nonet/lab/reports/replay.h"
#include "nonet/protocol/log_file.h"

namespace nonet::app {
namespace {

namespace fs = std::filesystem;

struct ExplainArguments {
  std::string log;
  double at = 0.0;
  std::optional<int> unum;
  std::optional<std::string> team;
  std::string data;
  bool json = false;
};

// The log of this player in a folder of logs.
std::string logOf(const ExplainArguments& arguments) {
  if (!fs::is_directory(arguments.log)) return arguments.log;
  std::string found;
  for (const auto& entry : fs::directory_iterator(arguments.log)) {
    if (!entry.is_regular_file() || entry.path().extension() != ".zst") continue;
    const protocol::LogReader reader(entry.path().string());
    if (!reader.header() || (arguments.unum && reader.header()->unum != *arguments.unum) ||
        (arguments.team && reader.header()->team != *arguments.team)) {
      continue;
    }
    if (!found.empty()) {
      throw std::runtime_error(
          fmt::format("{} and {} both fit: name one with --unum and --team", found, entry.path().string()));
    }
    found = entry.path().string();
  }
  if (found.empty()) throw std::runtime_error("no log of that player in " + arguments.log);
  return found;
}

// Our own logs say who recorded them: nobody else can be explained from one.
void checkRobot(const ExplainArguments& arguments, const std::string& log,
                const protocol::LogHeader& header) {
  if (arguments.unum.value_or(header.unum) == header.unum &&
      arguments.team.value_or(header.team) == header.team)
    return;
  throw std::runtime_error(
      fmt::format("{} is the log of {} {}: leave --unum and --team out, or give the folder", log, header.team,
                  header.unum));
}

int runExplain(const ExplainArguments& arguments) {
  const std::string log = logOf(arguments);
  nlohmann::ordered_json moment;
  double nearest = std::numeric_limits<double>::infinity();
  lab::ReplaySettings settings;
  settings.dataFolder = dataFolder(arguments.data);
  const protocol::LogReader reader(log);
  if (reader.header()) {
    checkRobot(arguments, log, *reader.header());
  } else {
    settings.unum = arguments.unum;
    settings.team = arguments.team;
  }
  settings.observer = [&](const agent::Session& session) {
    const double distance = std::abs(session.agent().world().game.time - arguments.at);
    // The game's clock may stand still: the last of its cycles is what the robot came to.
    if (distance > nearest) return;
    nearest = distance;
    moment = agent::traceOf(session.agent());
  };
  const std::string problem = lab::replay(log, settings).problem;
  if (moment.is_null()) throw std::runtime_error(problem.empty() ? log + ": no messages in it" : problem);
  if (!problem.empty()) fmt::print(stderr, "nonet explain: {}\n", problem);
  if (nearest > 1.0) {
    throw std::runtime_error(fmt::format("{}: nothing at {:.2f} s of the game, the nearest is {:.2f} s", log,
                                         arguments.at, moment["game_time"].get<double>()));
  }
  fmt::print("{}", arguments.json ? moment.dump() + "\n" : agent::traceText(moment));
  return 0;
}

}  // namespace

void addExplainCommand(CLI::App& app, int& exitCode) {
  CLI::App* command =
      app.add_subcommand("explain", "What a robot believed and wanted at one moment, from its log");
  auto arguments = std::make_shared<ExplainArguments>();
  command->add_option("log", arguments->log, "Log of an agent, or the folder of `nonet match --logs`")
      ->required()
      ->check(CLI::ExistingPath);
  command->add_option("--at", arguments->at, "Time of the game, s")->required();
  command->add_option("--unum", arguments->unum, "Which robot, for a folder or a foreign log");
  command->add_option("--team", arguments->team, "Of which team");
  command->add_option("--data", arguments->data, "Folder with params/ and skills/")
      ->check(CLI::ExistingDirectory);
  command->add_flag("--json", arguments->json, "As one JSON object, all values in it");
  command->footer("Example: nonet explain logs/match --team Nonet --unum 5 --at 123.4");
  command->callback([arguments, &exitCode] { exitCode = runExplain(*arguments); });
}

}  // namespace nonet::app
