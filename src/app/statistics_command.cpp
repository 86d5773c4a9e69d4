#include <filesystem>

#include <fmt/format.h>

#include "nonet/app/commands.h"
#include "nonet/app/console.h"
#include "nonet/lab/common/atomic_file.h"
#include "nonet/lab/match/frame_sources.h"

namespace nonet::app {
namespace {

using nlohmann::ordered_json;

struct StatisticsArguments {
  std::string log;
  std::string json;
};

// Two columns of figures, a row per kind.
std::string table(const ordered_json& statistics, const std::array<std::string, 2>& names) {
  const ordered_json& left = statistics.at("teams").at(0);
  const ordered_json& right = statistics.at("teams").at(1);
  std::string text = fmt::format("\n{:<24}{:>16}{:>16}\n", "", names[0], names[1]);
  const auto row = [&](const std::string& name, const std::string& key) {
    const auto cell = [&](const ordered_json& team) {
      return team.contains(key) ? team.at(key).dump() : std::string("-");
    };
    text += fmt::format("{:<24}{:>16}{:>16}\n", name, cell(left), cell(right));
  };
  const auto pairRow = [&](const std::string& name, const std::string& key, const std::string& of) {
    const auto cell = [&](const ordered_json& team) {
      return team.at(key).dump() + " of " + team.at(of).dump();
    };
    text += fmt::format("{:<24}{:>16}{:>16}\n", name, cell(left), cell(right));
  };
  row("goals", "goals");
  row("kick-off to goal, s", "kick_off_to_goal_s");
  pairRow("shots on target", "shots_on_target", "shots");
  row("kicks", "kicks");
  pairRow("passes completed", "passes_completed", "passes_tried");
  row("possession, %", "possession_percent");
  row("duels won", "duels_won");
  row("saves", "saves");
  row("falls", "falls");
  for (const char* group : {"set_pieces", "fouls"}) {
    ordered_json kinds = left.at(group);
    kinds.update(right.at(group));
    for (const auto& item : kinds.items()) {
      const std::string& kind = item.key();
      const auto cell = [&](const ordered_json& team) {
        if (!team.at(group).contains(kind)) return std::string("0");
        const ordered_json& value = team.at(group).at(kind);
        return value.is_object() ? fmt::format("{} ({} s each)", value.at("count").get<int>(),
                                               value.at("mean_s").get<double>())
                                 : value.dump();
      };
      std::string name = (std::string(group) == "fouls" ? "foul: " : "") + kind;
      std::replace(name.begin(), name.end(), '_', ' ');
      text += fmt::format("{:<24}{:>16}{:>16}\n", name, cell(left), cell(right));
    }
  }
  const ordered_json& thirds = statistics.at("ball_thirds_percent");
  text += fmt::format("ball in the thirds of {}, %: own {}, middle {}, the other's {}\n", names[0],
                      thirds.at(0).dump(), thirds.at(1).dump(), thirds.at(2).dump());
  return text;
}

std::string playerTable(const ordered_json& statistics, const std::array<std::string, 2>& names) {
  std::string text = fmt::format(
      "\n{:<14} {:>4} {:>4} {:>5} {:>6} {:>8} {:>6} {:>7} {:>7} {:>7} {:>5} {:>5}\n", "team", "unum", "type",
      "falls", "down s", "walked m", "mean", "best 1s", "best 3s", "touches", "kicks", "goals");
  for (std::size_t team = 0; team < 2; ++team) {
    for (const ordered_json& player : statistics.at("teams").at(team).at("players")) {
      text += fmt::format("{:<14} {:>4} {:>4} {:>5} {:>6} {:>8} {:>6} {:>7} {:>7} {:>7} {:>5} {:>5}\n",
                          names[team], player.at("unum").dump(), player.at("type").dump(),
                          player.at("falls").dump(), player.at("seconds_down").dump(),
                          player.at("walked_m").dump(), player.at("mean_speed").dump(),
                          player.at("best_speed_1s").dump(), player.at("best_speed_3s").dump(),
                          player.at("touches").dump(), player.at("kicks").dump(), player.at("goals").dump());
    }
  }
  return text;
}

constexpr int kDamaged = 3;  // the exit code of nonet replay

int runStatistics(const StatisticsArguments& arguments) {
  Console console;
  std::optional<lab::MatchStatistics> statistics;
  std::array<std::string, 2> names;
  const lab::MonitorLogEnd end = lab::readMonitorLog(arguments.log, [&](const lab::MonitorFrames& stream) {
    if (!statistics) statistics.emplace(stream.field());
    statistics->add(stream.frame());
    names = stream.teams();
    if (console.due()) console.progress(fmt::format("{:.0f} s of the game", stream.frame().time));
  });
  console.end();
  for (const std::size_t team : {0U, 1U}) {
    if (names[team].empty()) names[team] = team == 0 ? "left" : "right";
  }
  ordered_json json = statistics->toJson();
  json["names"] = names;
  fmt::print("{} against {}, {:.1f} s of the game\n{}{}", names[0], names[1],
             json.at("seconds").get<double>(), table(json, names), playerTable(json, names));
  if (!arguments.json.empty()) {
    lab::writeAtomically(arguments.json, json.dump() + "\n");
    fmt::print("everything in {}\n", arguments.json);
  }
  if (!end.problem.empty()) fmt::print(stderr, "nonet statistics: {}\n", end.problem);
  return end.end == protocol::LogReader::End::Damaged ? kDamaged : 0;
}

}  // namespace

void addStatisticsCommand(CLI::App& app, int& exitCode) {
  CLI::App* command = app.add_subcommand(
      "statistics", "What happened in a match, from its monitor log: shots, passes, falls, speeds");
  auto arguments = std::make_shared<StatisticsArguments>();
  command
      ->add_option("LOG", arguments->log,
                   "Monitor log: ours, the server's, or a kept stream; may be compressed")
      ->required()
      ->check(CLI::ExistingFile);
  command->add_option("--json", arguments->json, "File for all figures, as one line");
  command->footer(
      "Examples:\n"
      "  nonet match --in-process --minutes 2 --monitor-log logs/match.log && nonet statistics "
      "logs/match.log\n"
      "  nonet statistics sparkmonitor.log --json logs/figures.json\n"
      "What the words mean (touch, kick, shot, pass, duel, ...) is in docs/how-to.md.\n"
      "Exit codes: 0 all well, also if the log is torn, 1 no figures, 3 the log is damaged: figures up to "
      "there.");
  command->callback([arguments, &exitCode] { exitCode = runStatistics(*arguments); });
}

}  // namespace nonet::app
