#include "nonet/app/soak/match_soak.h"

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <optional>
#include <set>
#include <thread>

#include <fmt/format.h>

#include "nonet/app/agent_processes.h"
#include "nonet/app/data_folder.h"
#include "nonet/app/soak/memory_watch.h"
#include "nonet/app/soak/wake_watch.h"
#include "nonet/app/stop_signal.h"
#include "nonet/lab/common/atomic_file.h"
#include "nonet/lab/common/json_lines.h"
#include "nonet/math/random.h"
#include "nonet/protocol/log_file.h"

namespace nonet::app {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

constexpr double kEnding = 20.0;  // s for a match that was asked to stop
// A match may take so long (s), and so many times its game time more. It has failed then.
constexpr double kPatience = 120.0;
constexpr double kSlowest = 20.0;

/// A whole file that can be read to its end. Nothing is said of what stands in it.
bool isWhole(const fs::path& path) {
  try {
    protocol::LogReader reader(path.string());
    protocol::LogLine line;
    long lines = 0;
    while (reader.next(line)) ++lines;
    return reader.end() == protocol::LogReader::End::Whole && lines > 0;
  } catch (const protocol::LogError&) {
    return false;
  }
}

Json jsonFrom(const fs::path& path) {
  std::ifstream file(path);
  return Json::parse(file, nullptr, false);
}

class MatchSoak {
 public:
  MatchSoak(const MatchSoakSettings& settings, Console& console) : settings_(settings), console_(console) {
    fs::create_directories(settings.out);
    readPlayed();
  }

  bool run() {
    const StopSignal stopSignal;
    if (!played_.empty()) console_.say(fmt::format("resumed: {} matches are there", played_.size()));
    for (int index = 0; index < settings_.matches && !StopSignal::came(); ++index) {
      if (done_.contains(index)) continue;
      const Json line = play(soakMatch(settings_, index));
      if (line.empty()) break;
      lab::appendLine(file("matches.jsonl"), line);
      played_.push_back(line);
    }
    console_.end();
    const Json sum = sumUp(played_);
    lab::writeAtomically(file("result.json"), sum.dump(2) + "\n");
    return static_cast<int>(played_.size()) == settings_.matches && sum.value("faults", 1L) == 0;
  }

 private:
  std::string file(const std::string& name) const { return (fs::path(settings_.out) / name).string(); }

  /// What decides how each match is played.
  Json choice() const {
    return {{"seed", settings_.seed},
            {"players", settings_.players},
            {"minutes", settings_.minutes},
            {"kick_off_wait_s", settings_.kickOffWait},
            {"real_time_share", settings_.realTimeShare},
            {"eleven_share", settings_.elevenShare}};
  }

  void readPlayed() {
    const Json before = jsonFrom(file("soak.json"));
    const bool begun = fs::exists(file("soak.json")) || fs::exists(file("matches.jsonl"));
    if (begun && !before.is_object())
      throw std::runtime_error(
          fmt::format("{} is damaged or gone: put back what it held, or choose another folder with --out",
                      file("soak.json")));
    if (begun && before != choice())
      throw std::runtime_error(
          fmt::format("{} holds another soak ({}): give the same options or another --out", settings_.out,
                      before.dump()));
    lab::writeAtomically(file("soak.json"), choice().dump(2) + "\n");
    for (const Json& line : lab::readWholeLines(file("matches.jsonl"))) {
      const int index = line.value("index", -1);
      if (index >= settings_.matches) continue;
      if (line.value("seed", std::uint64_t{0}) != soakMatch(settings_, index).seed)
        throw std::runtime_error(
            fmt::format("{} holds another soak: give the same options or another --out", settings_.out));
      if (done_.insert(index).second) played_.push_back(line);
    }
  }

  /// Empty if a signal ended it.
  Json play(const SoakMatch& match) {
    const std::string name = fmt::format("match-{:03}", match.index);
    const std::string result = file(name + ".json");
    fs::remove(result);
    std::vector<std::string> command = {executablePath(), "match",    "--json",        result,
                                        "--logs",         file(name), "--monitor-log", file(name + ".mon")};
    const auto add = [&](const std::string& option, const auto& value) {
      command.push_back(option);
      command.push_back(fmt::format("{}", value));
    };
    add("--seed", match.seed);
    add("--players", match.players);
    add("--minutes", settings_.minutes);
    add("--kick-off-wait", settings_.kickOffWait);
    if (match.realTime) command.emplace_back("--realtime");
    const Clock::time_point begin = Clock::now();
    MemoryWatch server;
    MemoryWatch agents;
    std::optional<WakeWatch> wakes;
    if (match.realTime) wakes.emplace();
    AgentProcesses processes;
    processes.start(command, file(name + ".txt"));
    while (processes.poll(), processes.processes()[0].running) {
      const double time = std::chrono::duration<double>(Clock::now() - begin).count();
      const bool hangs =
          time > kPatience + kSlowest * (60.0 * settings_.minutes + 2.0 * settings_.kickOffWait);
      if (hangs || StopSignal::came()) {
        ::kill(processes.processes()[0].pid, SIGTERM);
        processes.stop(kEnding);
        if (!hangs) return {};
        fs::remove(result);
        break;
      }
      watch(match, time, processes.processes()[0].pid, server, agents);
      std::this_thread::sleep_for(std::chrono::milliseconds(500));
    }
    Json line = {{"index", match.index},
                 {"seed", match.seed},
                 {"real_time", match.realTime},
                 {"players", match.players}};
    line.update(countFaults(jsonFrom(result)));
    const bool serverCrashed = processes.processes()[0].signal != 0;
    line["crashed"] = line["crashed"].get<long>() + (serverCrashed ? 1 : 0);
    line["torn_logs"] = tornLogs(name, 2 * match.players);
    const bool faulty = isFaulty(line);
    line["faults"] = faulty ? 1 : 0;
    if (wakes) addWakes(line, *wakes);
    addMemory(line, server.growth(), agents.growth());
    if (faulty) {
      console_.say(fmt::format("{} (seed {}): {}", name, match.seed, line.dump()));
    } else if (!settings_.keepLogs) {
      tidy(name);
    }
    return line;
  }

  static bool isFaulty(const Json& line) {
    const long late = line["real_time"].get<bool>() ? 0 : line["late"].get<long>();
    return line["unfinished"].get<long>() + line["crashed"].get<long>() + line["missing"].get<long>() + late +
               line["torn_logs"].get<long>() >
           0;
  }

  /// How late the machine itself is, beside what answers by the clock were.
  static void addWakes(Json& line, const WakeWatch& wakes) {
    const DurationCounts delays = wakes.delays();
    line["machine_wakes"] = delays.count();
    for (std::size_t i = 0; i < DurationCounts::kBounds.size(); ++i) {
      const double bound = 1000.0 * DurationCounts::kBounds[i];
      line[fmt::format("machine_late_{:.0f}_ms", bound)] = delays.longerThan(i);
    }
    line["most_machine_delay_ms"] = 1000.0 * delays.longest();
    line["machine_watched_first"] = wakes.goesFirst();
  }

  static void addMemory(Json& line, const MemoryGrowth& server, const MemoryGrowth& agents) {
    line["most_server_mb"] = server.megabytes;
    if (server.perHour) line["most_server_mb_per_hour"] = *server.perHour;
    line["most_agent_mb"] = agents.megabytes;
    if (agents.perHour) line["most_agent_mb_per_hour"] = *agents.perHour;
  }

  void watch(const SoakMatch& match, double time, pid_t server, MemoryWatch& ofServer,
             MemoryWatch& ofAgents) {
    ofServer.look(time, server);
    for (const pid_t agent : childrenOf(server)) ofAgents.look(time, agent);
    if (!console_.due()) return;
    const Json sum = sumUp(played_);
    console_.progress(
        fmt::format("match {} of {} ({}, {} a side, seed {}), {:.0f} s; so far {} crashed, {} missing, {} "
                    "late, {} torn logs",
                    match.index + 1, settings_.matches, match.realTime ? "real time" : "lock-step",
                    match.players, match.seed, time, sum.value("crashed", 0L), sum.value("missing", 0L),
                    sum.value("late", 0L), sum.value("torn_logs", 0L)));
  }

  /// Logs that are missing count as torn.
  long tornLogs(const std::string& name, int expected) const {
    long whole = 0;
    if (fs::exists(file(name))) {
      for (const auto& log : fs::directory_iterator(file(name))) whole += isWhole(log.path()) ? 1 : 0;
    }
    return expected - whole + (isWhole(file(name + ".mon")) ? 0 : 1);
  }

  void tidy(const std::string& name) const {
    std::error_code ignored;
    fs::remove_all(file(name), ignored);
    for (const std::string ending : {".mon", ".txt", ".json"}) fs::remove(file(name + ending), ignored);
  }

  MatchSoakSettings settings_;
  Console& console_;
  std::vector<Json> played_;
  std::set<int> done_;
};

}  // namespace

SoakMatch soakMatch(const MatchSoakSettings& settings, int index) {
  Random random = Random(settings.seed).fork(static_cast<std::uint64_t>(index));
  SoakMatch match;
  match.index = index;
  match.seed = random.next() % 1000000;  // short enough to be typed
  match.realTime = random.uniform() < settings.realTimeShare;
  match.players = random.uniform() < settings.elevenShare ? 11 : settings.players;
  return match;
}

Json countFaults(const nlohmann::json& match) {
  Json line = {{"unfinished", 1L},  {"crashed", 0L},  {"missing", 0L}, {"late", 0L},
               {"lost_cycles", 0L}, {"messages", 0L}, {"cycles", 0L}};
  if (!match.is_object()) return line;
  line["unfinished"] = match.value("finished", false) ? 0L : 1L;
  line["cycles"] = match.value("cycles", 0L);
  long crashed = 0;
  long missing = 0;
  long late = match.value("timeouts", 0L);
  long lost = 0;
  long messages = 0;
  for (const auto& player : match.value("players", nlohmann::json::array())) {
    missing += player.value("connected", false) ? 0 : 1;
    crashed += player.value("ending", "").empty() ? 0 : 1;
    late += player.value("passed_over", 0L);
    lost += player.value("lost_cycles", 0L);
    messages += player.value("messages", 0L);
  }
  line.update(Json{{"crashed", crashed},
                   {"missing", missing},
                   {"late", late},
                   {"lost_cycles", lost},
                   {"messages", messages}});
  for (const std::string what : {"answers", "cycle_delays"}) {
    const nlohmann::json counts = match.value(what, nlohmann::json::object());
    for (const auto& [key, value] : counts.items()) {
      const bool longest = key == "longest_ms";
      line[longest ? fmt::format("most_{}_ms", what) : fmt::format("{}_{}", what, key)] = value;
    }
  }
  return line;
}

Json sumUp(const std::vector<Json>& matches) {
  Json sum = {
      {"matches", matches.size()}, {"real_time_matches", 0L}, {"matches_of_eleven", 0L}, {"faults", 0L}};
  for (const Json& match : matches) {
    if (match.value("real_time", false)) sum["real_time_matches"] = sum["real_time_matches"].get<long>() + 1;
    if (match.value("players", 0) == 11) sum["matches_of_eleven"] = sum["matches_of_eleven"].get<long>() + 1;
    for (const auto& [key, value] : match.items()) {
      if (key == "index" || key == "seed" || key == "players" || !value.is_number()) continue;
      if (key.starts_with("most_")) {
        sum[key] = std::max(sum.value(key, value.get<double>()), value.get<double>());
      } else {
        sum[key] = sum.value(key, 0L) + value.get<long>();
      }
    }
  }
  return sum;
}

bool soakMatches(const MatchSoakSettings& settings, Console& console) {
  return MatchSoak(settings, console).run();
}

}  // namespace nonet::app
