#include "nonet/app/tcp_match.h"

#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <stop_token>
#include <system_error>
#include <thread>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <spdlog/sinks/base_sink.h>
#include <spdlog/spdlog.h>

#include "nonet/app/agent_processes.h"
#include "nonet/app/play_client.h"
#include "nonet/app/play_command_line.h"
#include "nonet/lab/common/folder_lock.h"
#include "nonet/sim/server/server.h"

namespace nonet::app {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr double kFarewell = 5.0;  // s for the agents to end after the server has closed

/// What the server says goes above the progress line; before the match only warnings.
class ConsoleSink : public spdlog::sinks::base_sink<std::mutex> {
 public:
  explicit ConsoleSink(Console& console) : console_(console) {}
  void quiet(bool quiet) { quiet_ = quiet; }

 protected:
  void sink_it_(const spdlog::details::log_msg& message) override {
    if (quiet_ && message.level < spdlog::level::warn) return;
    console_.say(std::string(message.payload.data(), message.payload.size()));
  }
  void flush_() override {}

 private:
  Console& console_;
  std::atomic<bool> quiet_{true};
};

/// The default logger replaced for as long as this lives.
class LoggerGuard {
 public:
  explicit LoggerGuard(std::shared_ptr<spdlog::sinks::sink> sink) : before_(spdlog::default_logger()) {
    spdlog::set_default_logger(std::make_shared<spdlog::logger>("match", std::move(sink)));
  }
  ~LoggerGuard() { spdlog::set_default_logger(before_); }
  LoggerGuard(const LoggerGuard&) = delete;
  LoggerGuard& operator=(const LoggerGuard&) = delete;

 private:
  std::shared_ptr<spdlog::logger> before_;
};

/// A folder for the agents' reports, removed at the end.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "nonet-match-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr)
      throw std::system_error(errno, std::generic_category(), "cannot make the folder " + name);
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  fs::path path_;
};

class TcpMatch {
 public:
  TcpMatch(const TcpMatchSettings& settings, Console& console)
      : settings_(settings),
        console_(console),
        watcher_(settings.match),
        sink_(std::make_shared<ConsoleSink>(console)),
        logger_(sink_),
        server_(lab::simulationSettings(settings.match), settings.match.seed, serverSettings()) {}

  lab::MatchResult run() {
    if (!settings_.logs.empty()) lab::makeFolder(settings_.logs);
    console_.say(fmt::format("{}, seed {}, {}; agents on port {}, monitors on port {}",
                             lab::matchTitle(settings_.match), settings_.match.seed,
                             settings_.realTime ? "real time" : "lock-step", server_.agentPort(),
                             server_.monitorPort()));
    startAgents();
    server_.onCycle([this](const sim::Simulation& simulation) { afterCycle(simulation); });
    {
      const std::jthread guard([this](const std::stop_token& over) { watchProcesses(over); });
      server_.run();
    }
    const double wallTime = std::chrono::duration<double>(Clock::now() - started_).count();
    console_.end();
    processes_.stop(kFarewell);
    if (watcher_.result().cycles == 0) throw std::runtime_error("the match did not begin" + reasons());
    return collect(wallTime);
  }

 private:
  sim::ServerSettings serverSettings() const {
    sim::ServerSettings server;
    server.address = "127.0.0.1";
    server.agentPort = settings_.port;
    server.monitorPort = settings_.monitorPort;
    server.lockStep = !settings_.realTime;
    server.realTime = settings_.realTime;
    server.answerTimeout = settings_.answerTimeout;
    server.players = settings_.match.left.players + settings_.match.right.players;
    server.monitorLog = settings_.match.monitorLog;
    server.endWithMatch = true;
    server.handleSignals = true;
    return server;
  }

  static std::string nameOf(const lab::PlayerRecord& player) {
    return fmt::format("{}_{}", player.team, player.unum);
  }

  void startAgents() {
    for (const lab::PlayerRecord& player : watcher_.result().players) {
      const agent::AgentChoice agent = lab::agentChoice(settings_.match, player.rightTeam, player.unum);
      const lab::TeamSettings& team = player.rightTeam ? settings_.match.right : settings_.match.left;
      std::vector<std::string> command = playCommand(
          PlayProgram(), agent,
          {"127.0.0.1", server_.agentPort(), true, team.dataFolder, folder_.file(nameOf(player) + ".json")});
      const auto add = [&](const std::string& option, const std::string& value) {
        command.push_back(option);
        command.push_back(value);
      };
      if (!settings_.logs.empty())
        add("--record", (fs::path(settings_.logs) / (nameOf(player) + ".zst")).string());
      if (settings_.draw) command.emplace_back("--draw");
      if (!settings_.traces.empty())
        add("--trace", (fs::path(settings_.traces) / (nameOf(player) + ".trace")).string());
      processes_.start(command, folder_.file(nameOf(player) + ".txt"));
    }
  }

  void afterCycle(const sim::Simulation& simulation) {
    if (watcher_.result().cycles == 0) {
      begun_ = true;
      started_ = Clock::now();
      sink_->quiet(false);
    }
    watcher_.update(simulation);
    if (console_.due()) console_.progress(watcher_.progress(simulation));
  }

  /// In a thread of its own: tells of agents that end, and ends the match if it cannot begin or nobody is
  /// left.
  void watchProcesses(const std::stop_token& over) {
    while (!over.stop_requested()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      processes_.poll();
      std::size_t running = 0;
      for (std::size_t i = 0; i < processes_.processes().size(); ++i) {
        AgentProcesses::Process& process = processes_.processes()[i];
        running += process.running ? 1 : 0;
        if (process.running || process.told || over.stop_requested()) continue;
        process.told = true;
        const std::string reason = endedBy(process);
        if (reason.empty()) continue;
        early_[i] = reason;
        console_.say(fmt::format("{} has ended: {}", nameOf(watcher_.result().players[i]), early_[i]));
        if (!begun_) server_.stop();
      }
      if (running == 0) server_.stop();
    }
  }

  /// Empty for an agent that ended because the server did.
  static std::string endedBy(const AgentProcesses::Process& process) {
    const bool serverGone = process.signal == 0 && process.exitCode == static_cast<int>(PlayExit::ServerGone);
    return serverGone ? "" : endingOf(process);
  }

  std::string reasons() const {
    std::string text;
    for (const auto& [player, reason] : early_) {
      text += fmt::format("\n  {}: {}", nameOf(watcher_.result().players[player]), reason);
    }
    return text;
  }

  lab::MatchResult collect(double wallTime) {
    lab::MatchResult result = watcher_.finish(server_.simulation());
    result.wallTime = wallTime;
    const sim::Server::Statistics statistics = server_.statistics();
    result.timeouts = statistics.timeouts;
    result.droppedMessages = statistics.droppedMessages;
    result.answers = statistics.answers;
    result.delays = statistics.delays;
    if (const std::string error = server_.recordingError(); !error.empty()) result.warnings.push_back(error);
    for (std::size_t i = 0; i < result.players.size(); ++i) {
      lab::PlayerRecord& player = result.players[i];
      const AgentProcesses::Process& process = processes_.processes()[i];
      player.ending = endedBy(process);
      if (player.ending.empty() && player.gone) player.ending = "lost its connection";
      std::ifstream file(folder_.file(nameOf(player) + ".json"));
      const auto report = nlohmann::json::parse(file, nullptr, false);
      if (!report.is_object()) continue;
      player.messages = report.value("messages", 0L);
      player.passedOver = report.value("passed_over", 0L);
      player.lostCycles = report.value("lost_cycles", 0L);
      for (const std::string& warning : report.value("warnings", std::vector<std::string>()))
        result.warnings.push_back(warning);
    }
    return result;
  }

  TcpMatchSettings settings_;
  Console& console_;
  lab::MatchWatcher watcher_;
  std::shared_ptr<ConsoleSink> sink_;
  LoggerGuard logger_;
  TemporaryFolder folder_;
  sim::Server server_;
  AgentProcesses processes_;
  std::map<std::size_t, std::string> early_;  // why agents ended before the match did, by index of the player
  std::atomic<bool> begun_{false};
  Clock::time_point started_;
};

}  // namespace

lab::MatchResult playOverTcp(const TcpMatchSettings& settings, Console& console) {
  return TcpMatch(settings, console).run();
}

}  // namespace nonet::app
