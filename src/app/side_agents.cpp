#include <csignal>
#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "nonet/app/play_client.h"
#include "nonet/app/series_games.h"

namespace nonet::app {
namespace {

std::optional<PlayProgram> programOf(const lab::SideSettings& side) {
  if (!side.nonet()) return std::nullopt;
  return side.executable.empty() ? PlayProgram() : PlayProgram(side.executable);
}

// Told to the program, for else it would play with what NONET_DATA says, which is meant for this one. Empty:
// it finds none by itself, or cannot be told.
std::string dataOf(const PlayProgram& program) {
  return program.knows("--data") ? lab::dataBeside(program.executable()) : "";
}

}  // namespace

std::string filledIn(std::string text,
                     std::initializer_list<std::pair<std::string_view, std::string>> values) {
  for (const auto& [key, value] : values) {
    const std::string mark = fmt::format("{{{}}}", key);
    for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at + value.size()))
      text.replace(at, mark.size(), value);
  }
  return text;
}

SideAgents::Programs::Programs(const lab::SeriesSettings& settings)
    : a(programOf(settings.a)), b(programOf(settings.b)) {}

SideAgents::SideAgents(const lab::SeriesSettings& settings, const lab::SeriesGame& game,
                       const Programs& programs, const lab::MatchSettings& match,
                       const std::string& dataFolder, const std::string& logs)
    : settings_(settings),
      game_(game),
      programs_(programs),
      match_(match),
      dataFolder_(dataFolder),
      logs_(logs) {}

void SideAgents::start(bool rightTeam, const ServerPlace& server, bool lockStep) {
  const bool sideB = rightTeam == game_.aLeft();
  const lab::SideSettings& side = sideB ? settings_.b : settings_.a;
  const std::optional<PlayProgram>& program = sideB ? programs_.b : programs_.a;
  if (!program) return startForeign(side, rightTeam, server);
  const lab::TeamSettings& team = rightTeam ? match_.right : match_.left;
  for (int unum = 1; unum <= team.players; ++unum) {
    const std::string name = fmt::format("{}/{}_{}", logs_, team.name, unum);
    PlayPlace place{server.host, server.port, lockStep, team.dataFolder, name + ".json"};
    if (place.dataFolder.empty()) place.dataFolder = side.ours() ? dataFolder_ : dataOf(*program);
    agents_.push_back({rightTeam, false, place.report});
    processes_.start(playCommand(*program, lab::agentChoice(match_, rightTeam, unum), place), name + ".txt");
  }
}

void SideAgents::startForeign(const lab::SideSettings& side, bool rightTeam, const ServerPlace& server) {
  const lab::TeamSettings& team = rightTeam ? match_.right : match_.left;
  const std::string line = filledIn(side.command, {{"host", server.host},
                                                   {"port", std::to_string(server.port)},
                                                   {"monitor", std::to_string(server.monitorPort)},
                                                   {"team", team.name},
                                                   {"players", std::to_string(team.players)},
                                                   {"seed", std::to_string(game_.seed)},
                                                   {"folder", logs_}});
  agents_.push_back({rightTeam, true, {}});
  processes_.startShell(line, fmt::format("{}/{}.txt", logs_, team.name));
}

// A command that starts agents in the background ends well; an agent of Nonet ends when the server has gone.
bool SideAgents::crashed(std::size_t i) const {
  const AgentProcesses::Process& process = processes_.processes()[i];
  if (process.running) return false;
  const int well = agents_[i].foreign ? 0 : static_cast<int>(PlayExit::ServerGone);
  const bool asked = process.signal == SIGTERM || process.exitCode == static_cast<int>(PlayExit::Stopped);
  return !asked && (process.signal != 0 || process.exitCode != well);
}

std::string SideAgents::trouble() {
  processes_.poll();
  for (std::size_t i = 0; i < agents_.size(); ++i) {
    AgentProcesses::Process& process = processes_.processes()[i];
    if (process.told || !crashed(i)) continue;
    process.told = true;
    const lab::TeamSettings& team = agents_[i].rightTeam ? match_.right : match_.left;
    return fmt::format("{}: {}", agents_[i].foreign ? "the command of team " + team.name : team.name,
                       endingOf(process));
  }
  return "";
}

// What a command ends with that waited for its agents tells no more than that the game was over.
bool SideAgents::crashedInGame(std::size_t i) const {
  const AgentProcesses::Process& process = processes_.processes()[i];
  if (!agents_[i].foreign || process.told) return crashed(i);
  return crashed(i) && process.signal != 0;
}

void SideAgents::addTo(lab::GameRecord& record) {
  struct Sum {
    int crashed = 0;
    long late = 0;
    long lost = 0;
    double processorTime = 0.0;
  };
  std::array<Sum, 2> sums;  // A, B
  for (std::size_t i = 0; i < agents_.size(); ++i) {
    Sum& sum = sums[agents_[i].rightTeam == game_.aLeft() ? 1 : 0];
    sum.crashed += crashedInGame(i) ? 1 : 0;
    sum.processorTime += processes_.processes()[i].processorTime;
    std::ifstream file(agents_[i].report);
    const auto report = nlohmann::json::parse(file, nullptr, false);
    if (!report.is_object()) continue;
    sum.late += report.value("passed_over", 0L);
    sum.lost += report.value("lost_cycles", 0L);
  }
  record.line["crashed_a"] = sums[0].crashed;
  record.line["crashed_b"] = sums[1].crashed;
  for (const std::size_t side : {0U, 1U}) {
    const char* letter = side == 0 ? "a" : "b";
    record.times[fmt::format("late_{}", letter)] = sums[side].late;
    record.times[fmt::format("lost_{}", letter)] = sums[side].lost;
    record.times[fmt::format("processor_time_{}_s", letter)] = sums[side].processorTime;
  }
}

}  // namespace nonet::app
