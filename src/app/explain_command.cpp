#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "nonet/agent/trace.h"
#include "nonet/app/commands.h"
#include "nonet/app/data_folder.h"
#include "nonet/lab/reports/replay.h"
#include "nonet/protocol/log_file.h"

namespace nonet::app {
namespace {

namespace fs = std::filesystem;

constexpr double kNear = 1.0;  // s of the game

struct ExplainArguments {
  std::string log;
  double at = 0.0;
  std::optional<int> unum;
  std::optional<std::string> team;
  std::string data;
  bool json = false;
};

// The logs of one player in a folder of logs. Who came back to a server has several, one for each of its
// lives.
std::vector<std::string> logsOf(const ExplainArguments& arguments) {
  if (!fs::is_directory(arguments.log)) return {arguments.log};
  std::vector<std::string> found;
  std::optional<protocol::LogHeader> first;
  for (const auto& entry : fs::directory_iterator(arguments.log)) {
    if (!entry.is_regular_file() || entry.path().extension() != ".zst") continue;
    const protocol::LogReader reader(entry.path().string());
    if (!reader.header() || (arguments.unum && reader.header()->unum != *arguments.unum) ||
        (arguments.team && reader.header()->team != *arguments.team)) {
      continue;
    }
    if (!first) first = reader.header();
    if (reader.header()->unum != first->unum || reader.header()->team != first->team) {
      throw std::runtime_error(fmt::format("{} and {} both fit: name one with --unum and --team",
                                           found.front(), entry.path().string()));
    }
    found.push_back(entry.path().string());
  }
  if (found.empty()) throw std::runtime_error("no log of that player in " + arguments.log);
  std::sort(found.begin(), found.end());
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

struct Moment {
  std::string log;
  std::string problem;                                        // of the log, in a sentence
  nlohmann::ordered_json trace;                               // null if there is no message in it
  double distance = std::numeric_limits<double>::infinity();  // s of the game from the wanted one
};

// The moment of this log next to the wanted one.
Moment momentOf(const std::string& log, const ExplainArguments& arguments) {
  Moment moment;
  moment.log = log;
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
    if (distance > moment.distance) return;
    moment.distance = distance;
    moment.trace = agent::traceOf(session.agent());
  };
  moment.problem = lab::replay(log, settings).problem;
  if (moment.trace.is_null() && moment.problem.empty()) moment.problem = log + ": no messages in it";
  return moment;
}

int runExplain(const ExplainArguments& arguments) {
  Moment moment;
  std::vector<std::string> holding;
  for (const std::string& log : logsOf(arguments)) {
    Moment found = momentOf(log, arguments);
    if (found.distance <= kCycleTime) holding.push_back(log);
    if (moment.log.empty() || found.distance < moment.distance) moment = std::move(found);
  }
  if (moment.trace.is_null()) throw std::runtime_error(moment.problem);
  if (holding.size() > 1) {
    throw std::runtime_error(fmt::format("{} and {} both hold {:.2f} s of the game: give the file",
                                         holding[0], holding[1], arguments.at));
  }
  if (!moment.problem.empty()) fmt::print(stderr, "nonet explain: {}\n", moment.problem);
  if (moment.distance > kNear) {
    throw std::runtime_error(fmt::format("{}: nothing at {:.2f} s of the game, the nearest is {:.2f} s",
                                         moment.log, arguments.at, moment.trace["game_time"].get<double>()));
  }
  fmt::print("{}", arguments.json ? moment.trace.dump() + "\n" : agent::traceText(moment.trace));
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
