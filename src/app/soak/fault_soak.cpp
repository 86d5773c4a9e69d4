#include "nonet/app/soak/fault_soak.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <optional>
#include <thread>

#include <fmt/format.h>

#include "nonet/agent/agent_setup.h"
#include "nonet/app/agent_processes.h"
#include "nonet/app/data_folder.h"
#include "nonet/app/soak/false_clock.h"
#include "nonet/app/soak/fault_proxy.h"
#include "nonet/app/soak/monitor_watch.h"
#include "nonet/app/stop_signal.h"
#include "nonet/math/random.h"

namespace nonet::app {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;
using protocol::TeamSide;

constexpr double kLongestSilence = 1.0;  // s that the stream may stop while only one of them is harmed
constexpr double kStop = 5.0;            // s, SIGSTOP
constexpr double kStarvation = 0.2;      // s without processor
constexpr double kSpoiled = 3.0;         // s of delayed or repeated messages
constexpr double kDelay = 0.2;           // s
constexpr long kClockJump = 3600;        // s, ahead and then back
constexpr double kToBegin = 60.0;        // s until all are in play at first

/// One player of ours. The last of each team plays through a proxy.
struct Fellow {
  MonitorWatch::Player player{TeamSide::Left, 0};
  std::unique_ptr<FaultProxy> proxy;
  std::size_t process = 0;  // index into the processes

  std::string name() const {
    return fmt::format("{}_{}", player.first == TeamSide::Left ? "Left" : "Right", player.second);
  }
};

class FaultSoak {
 public:
  FaultSoak(const FaultSoakSettings& settings, Console& console)
      : settings_(settings), console_(console), random_(settings.seed) {
    fs::create_directories(settings.out);
    const auto kinds = plannedKinds();
    if (std::find(kinds.begin(), kinds.end(), "clock") != kinds.end()) clock_.emplace(file("clock"));
    startServer();
    watch_.emplace(monitorPort_);
    for (int unum = 1; unum <= settings.players; ++unum) {
      for (const TeamSide side : {TeamSide::Left, TeamSide::Right}) {
        Fellow& fellow = fellows_.emplace_back();
        fellow.player = {side, unum};
        if (unum == settings.players) fellow.proxy = std::make_unique<FaultProxy>(agentPort_);
      }
    }
    for (Fellow& fellow : fellows_) start(fellow);
  }
  ~FaultSoak() {
    processes_.stop(0.0);
    for (const auto& process : processes_.processes()) FalseClock::clean(process.pid);
  }
  FaultSoak(const FaultSoak&) = delete;
  FaultSoak& operator=(const FaultSoak&) = delete;

  Json run() {
    const StopSignal stopSignal;
    if (!awaitAll(kToBegin))
      throw std::runtime_error("the match did not begin: " + missing() + " not in play; see " +
                               settings_.out);
    console_.say(fmt::format("{} players are there", fellows_.size()));
    for (const std::string& kind : plan()) {
      pause(settings_.pause * random_.uniform(0.5, 1.5));
      if (StopSignal::came()) break;
      harm(kind);
    }
    console_.end();
    Json result = Json::object();
    bool complete = !StopSignal::came();
    for (const auto& [kind, tally] : tallies_) {
      result[kind] = {{"times", tally.times},
                      {"survived", tally.survived},
                      {"longest_s", tally.longest},
                      {"troubles", tally.troubles}};
      complete = complete && tally.survived == tally.times;
    }
    return {{"complete", complete}, {"faults", result}};
  }

 private:
  struct Tally {
    int times = 0;
    int survived = 0;
    double longest = 0.0;  // s until all were in play again
    std::vector<std::string> troubles;
  };

  // -- processes

  std::string file(const std::string& name) const { return (fs::path(settings_.out) / name).string(); }

  void startServer() {
    std::vector<std::string> command = {executablePath(), "serve",
                                        "--left",         "Left",
                                        "--right",        "Right",
                                        "--set",          "AutomaticKickOff=true",
                                        "--set",          "RuleHalfTime=36000"};
    const std::string output = file(fmt::format("server-{}.txt", ++servers_));
    const auto port = [](int known) { return std::to_string(known); };
    command.insert(command.end(), {"--port", port(agentPort_), "--monitor-port", port(monitorPort_)});
    server_ = processes_.processes().size();
    processes_.start(command, output, clockVariables());
    if (agentPort_ != 0) return;
    // It says which ports it has found.
    for (int i = 0; i < 200 && agentPort_ == 0; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      std::ifstream stream(output);
      const std::string text{std::istreambuf_iterator<char>(stream), {}};
      agentPort_ = numberAfter(text, "agents on port ");
      monitorPort_ = numberAfter(text, "monitors on port ");
    }
    if (agentPort_ == 0) throw std::runtime_error("the server did not start; see " + output);
  }

  static int numberAfter(const std::string& text, const std::string& words) {
    const std::size_t at = text.find(words);
    return at == std::string::npos || text.find('\n', at) == std::string::npos
               ? 0
               : std::atoi(text.c_str() + at + words.size());
  }

  void start(Fellow& fellow, const std::string& record = {}) {
    const int unum = fellow.player.second;
    const std::string name = fellow.name();
    const std::string folder = file("logs-" + name);
    fs::create_directories(folder);
    const int port = fellow.proxy ? fellow.proxy->port() : agentPort_;
    const std::string log = record.empty() ? fmt::format("{}/{}.zst", folder, ++starts_) : record;
    fellow.process = processes_.processes().size();
    processes_.start(
        {executablePath(), "play", "--reconnect", "--wait", "60", "--port", std::to_string(port), "--team",
         fellow.player.first == TeamSide::Left ? "Left" : "Right", "--unum", std::to_string(unum), "--type",
         std::to_string(agent::usualRobotType(unum)), "--record", log},
        file(fmt::format("{}-{}.txt", name, ++starts_)),
        fellow.proxy ? clockVariables() : std::vector<std::string>{});
  }

  /// The server and those behind a proxy have a wall clock of their own, if it is to jump.
  std::vector<std::string> clockVariables() const {
    return clock_ ? clock_->variables() : std::vector<std::string>{};
  }

  void signal(std::size_t process, int number) { ::kill(processes_.processes()[process].pid, number); }

  /// Killed, and waited for, so that its place in the kernel is free.
  void kill(std::size_t process) {
    signal(process, SIGKILL);
    while (processes_.poll(), processes_.processes()[process].running)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }

  // -- looking

  std::string missing(const Fellow* except = nullptr) const {
    const auto players = watch_->players();
    std::string names;
    for (const Fellow& fellow : fellows_) {
      if (&fellow == except || players.contains(fellow.player)) continue;
      names += (names.empty() ? "" : ", ") + fellow.name();
    }
    return names;
  }

  bool awaitAll(double seconds) {
    const Clock::time_point end =
        Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
    while (!missing().empty()) {
      if (Clock::now() > end || StopSignal::came()) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return true;
  }

  /// Waits; whoever is missing meanwhile, but for the one who is harmed, is a trouble.
  void pause(double seconds, const Fellow* harmed = nullptr, std::string* trouble = nullptr) {
    const Clock::time_point begin = Clock::now();
    while (std::chrono::duration<double>(Clock::now() - begin).count() < seconds && !StopSignal::came()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      if (trouble != nullptr && trouble->empty() && !missing(harmed).empty())
        *trouble = missing(harmed) + " went out of play";
    }
  }

  // -- faults

  std::vector<std::string> plannedKinds() const {
    return settings_.kinds.empty() ? faultKinds() : settings_.kinds;
  }

  std::vector<std::string> plan() {
    std::vector<std::string> all;
    for (const std::string& kind : plannedKinds())
      all.insert(all.end(), static_cast<std::size_t>(settings_.times), kind);
    for (std::size_t i = all.size(); i > 1; --i) std::swap(all[i - 1], all[random_.below(i)]);
    return all;
  }

  Fellow& choose(bool behindProxy) {
    std::vector<Fellow*> able;
    for (Fellow& fellow : fellows_) {
      if ((fellow.proxy != nullptr) == behindProxy) able.push_back(&fellow);
    }
    return *able[random_.below(able.size())];
  }

  static bool hitsAll(const std::string& kind) {
    return kind == "server" || kind == "starve" || kind == "clock";
  }

  void harm(const std::string& kind) {
    using Action = void (FaultSoak::*)(Fellow&, std::string&);
    struct Kind {
      Action action;
      bool behindProxy;
    };
    static const std::map<std::string, Kind> kKinds = {
        {"kill", {&FaultSoak::killAndRestart, false}}, {"stop", {&FaultSoak::stopAwhile, false}},
        {"starve", {&FaultSoak::starve, false}},       {"cut", {&FaultSoak::cut, true}},
        {"half-frame", {&FaultSoak::cutWithin, true}}, {"delay", {&FaultSoak::delay, true}},
        {"repeat", {&FaultSoak::repeat, true}},        {"server", {&FaultSoak::restartServer, false}},
        {"full-disk", {&FaultSoak::fillDisk, false}},  {"lost-folder", {&FaultSoak::loseFolder, true}},
        {"clock", {&FaultSoak::jumpClock, true}}};
    const Kind& what = kKinds.at(kind);
    Fellow& fellow = choose(what.behindProxy);
    console_.say(
        fmt::format("{} {}: {}", kind, tallies_[kind].times + 1, hitsAll(kind) ? "all" : fellow.name()));
    std::string trouble;
    watch_->longestSilence();
    const std::size_t connectedTo = server_;
    departuresBefore_ = watch_->departures(fellow.player);
    (this->*what.action)(fellow, trouble);
    const Clock::time_point begin = Clock::now();
    const bool back = awaitAll(settings_.patience);
    if (StopSignal::came()) return console_.say("  stopped: this one does not count");
    const double took = std::chrono::duration<double>(Clock::now() - begin).count();
    if (!back) {
      trouble += (trouble.empty() ? "" : "; ") + missing() +
                 fmt::format(" not in play after {:.0f} s", settings_.patience) + revive();
      awaitAll(kToBegin);
    }
    const double silence = watch_->longestSilence();
    if (server_ == connectedTo && silence > kLongestSilence)
      trouble += (trouble.empty() ? "" : "; ") + fmt::format("the match stood still for {:.1f} s", silence);
    Tally& tally = tallies_[kind];
    ++tally.times;
    tally.longest = std::max(tally.longest, took);
    if (trouble.empty()) {
      ++tally.survived;
    } else {
      tally.troubles.push_back(trouble);
      console_.say("  " + trouble);
    }
  }

  /// Whoever has ended starts anew, so that the faults that follow are not blamed for it. Says who.
  std::string revive() {
    processes_.poll();
    std::string ended;
    for (Fellow& fellow : fellows_) {
      const AgentProcesses::Process& process = processes_.processes()[fellow.process];
      if (process.running) continue;
      ended += "; " + fellow.name() + " has ended: " + endingOf(process);
      start(fellow);
    }
    return ended;
  }

  /// The robot of one whose connection has ended goes within a second, be it that the next one comes at once.
  void awaitGone(const Fellow& fellow, std::string& trouble) {
    for (int i = 0; i < 100; ++i) {
      if (watch_->departures(fellow.player) > departuresBefore_) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    trouble = fellow.name() + " stayed on the field";
  }

  void killAndRestart(Fellow& fellow, std::string& trouble) {
    kill(fellow.process);
    awaitGone(fellow, trouble);
    pause(random_.uniform(0.0, 1.0), &fellow, &trouble);
    start(fellow);
  }

  void stopAwhile(Fellow& fellow, std::string& trouble) {
    signal(fellow.process, SIGSTOP);
    pause(kStop, &fellow, &trouble);
    signal(fellow.process, SIGCONT);
    pause(1.0, nullptr, &trouble);
  }

  void starve(Fellow& /*fellow*/, std::string& trouble) {
    for (const Fellow& each : fellows_) signal(each.process, SIGSTOP);
    signal(server_, SIGSTOP);
    std::this_thread::sleep_for(std::chrono::duration<double>(kStarvation));
    signal(server_, SIGCONT);
    for (const Fellow& each : fellows_) signal(each.process, SIGCONT);
    pause(1.0, nullptr, &trouble);
  }

  void cut(Fellow& fellow, std::string& trouble) {
    fellow.proxy->cut();
    awaitGone(fellow, trouble);
  }

  void cutWithin(Fellow& fellow, std::string& trouble) {
    fellow.proxy->cutWithinMessage();
    awaitGone(fellow, trouble);
  }

  void delay(Fellow& fellow, std::string& trouble) {
    fellow.proxy->delay(kDelay);
    pause(kSpoiled, nullptr, &trouble);
    fellow.proxy->delay(0.0);
  }

  void repeat(Fellow& fellow, std::string& trouble) {
    fellow.proxy->repeat(true);
    pause(kSpoiled, nullptr, &trouble);
    fellow.proxy->repeat(false);
  }

  void restartServer(Fellow& /*fellow*/, std::string& trouble) {
    kill(server_);
    std::this_thread::sleep_for(std::chrono::duration<double>(random_.uniform(0.0, 2.0)));
    startServer();
    for (int i = 0; i < 500 && !watch_->connected(); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    if (!watch_->connected()) trouble = "the server did not come back";
  }

  void fillDisk(Fellow& fellow, std::string& trouble) {
    kill(fellow.process);
    awaitGone(fellow, trouble);
    start(fellow, "/dev/full");
  }

  /// The next log after a cut cannot be created.
  void loseFolder(Fellow& fellow, std::string& trouble) {
    fs::remove_all(file("logs-" + fellow.name()));
    cut(fellow, trouble);
  }

  /// The wall clock of the server and of two players: an hour ahead, then back, then true again.
  void jumpClock(Fellow& /*fellow*/, std::string& trouble) {
    for (const long offset : {kClockJump, -kClockJump, 0L}) {
      clock_->jump(offset);
      pause(2.0 * FalseClock::kTillSeen, nullptr, &trouble);
    }
  }

  FaultSoakSettings settings_;
  Console& console_;
  Random random_;
  std::optional<FalseClock> clock_;
  int agentPort_ = 0;
  int monitorPort_ = 0;
  int servers_ = 0;
  int starts_ = 0;
  int departuresBefore_ = 0;  // of the one who is harmed
  AgentProcesses processes_;
  std::size_t server_ = 0;
  std::optional<MonitorWatch> watch_;
  std::vector<Fellow> fellows_;
  std::map<std::string, Tally> tallies_;
};

}  // namespace

std::vector<std::string> faultKinds() {
  return {"kill",   "stop",   "starve",    "cut",         "half-frame", "delay",
          "repeat", "server", "full-disk", "lost-folder", "clock"};
}

Json soakFaults(const FaultSoakSettings& settings, Console& console) {
  return FaultSoak(settings, console).run();
}

}  // namespace nonet::app
