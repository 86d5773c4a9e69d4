#include "nonet/app/series_games.h"

#include <atomic>
#include <chrono>
#include <filesystem>
#include <stdexcept>
#include <stop_token>
#include <thread>

#include <fmt/format.h>

#include "nonet/app/option_checks.h"
#include "nonet/lab/match/frame_sources.h"
#include "nonet/sim/server/server.h"

namespace nonet::app {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr double kLongestStart = 90.0;  // s until all players must be there
constexpr double kFarewell = 5.0;       // s for the agents to end after the server has closed
constexpr long kCyclesBetweenReports = 50;

// A game on the embedded server of this process, agents over TCP.
class TcpGame {
 public:
  TcpGame(const lab::SeriesGame& game, const lab::MatchSettings& match, bool lockStep, SideAgents& agents,
          const std::function<bool(double)>& goOn)
      : game_(game),
        match_(match),
        lockStep_(lockStep),
        agents_(agents),
        goOn_(goOn),
        watcher_(match),
        statistics_({match.settings.fieldLength, match.settings.fieldWidth, match.settings.goalWidth}),
        server_(lab::simulationSettings(match), match.seed, serverSettings()) {}

  lab::GameRecord play() {
    for (const bool rightTeam : {false, true})
      agents_.start(rightTeam, {"127.0.0.1", server_.agentPort(), server_.monitorPort()}, lockStep_);
    server_.onCycle([this](const sim::Simulation& simulation) { afterCycle(simulation); });
    {
      const std::jthread guard([this](const std::stop_token& over) { watchStart(over); });
      server_.run();
    }
    agents_.stop(kFarewell);
    return record();
  }

 private:
  sim::ServerSettings serverSettings() const {
    sim::ServerSettings server;
    server.agentPort = 0;
    server.monitorPort = 0;
    server.lockStep = lockStep_;
    server.realTime = !lockStep_;
    server.players = match_.left.players + match_.right.players;
    server.monitorLog = match_.monitorLog;
    server.endWithMatch = true;
    return server;
  }

  void afterCycle(const sim::Simulation& simulation) {
    begun_ = true;
    watcher_.update(simulation);
    if (const lab::Frame* frame = frames_.cycle(simulation)) {
      statistics_.add(*frame);
      score_ = frame->score;
    }
    const lab::MatchResult& result = watcher_.result();
    if (result.cycles % kCyclesBetweenReports == 0 && !goOn_(result.gameTime)) server_.stop();
    if (simulation.agents().empty()) {
      trouble_ = "all players have left";
      server_.stop();
    }
  }

  // In a thread of its own: ends what cannot begin.
  void watchStart(const std::stop_token& over) {
    const auto start = Clock::now();
    while (!over.stop_requested() && !begun_) {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      std::string trouble = agents_.trouble();
      if (trouble.empty() && std::chrono::duration<double>(Clock::now() - start).count() > kLongestStart)
        trouble = fmt::format("not all {} players came within {} s",
                              match_.left.players + match_.right.players, kLongestStart);
      if (trouble.empty() && goOn_(0.0)) continue;
      if (begun_) break;
      startTrouble_ = trouble;
      server_.stop();
      break;
    }
  }

  lab::GameRecord record() {
    const lab::MatchResult result = watcher_.finish(server_.simulation());
    if (!result.finished && goOn_(result.gameTime)) {
      const std::string& trouble = startTrouble_.empty() ? trouble_ : startTrouble_;
      throw std::runtime_error(fmt::format("game {} of pair {} did not end: {}", game_.game, game_.pair,
                                           trouble.empty() ? "the server stopped" : trouble));
    }
    lab::GameRecord record = lab::gameRecord(game_, score_[0], score_[1], result.gameTime, result.finished);
    record.line["signature"] = fmt::format("{:016x}", result.signature);
    record.line["statistics"] = statistics_.toJson();
    for (const bool rightTeam : {false, true}) {
      const auto left = std::count_if(result.players.begin(), result.players.end(), [&](const auto& player) {
        return player.rightTeam == rightTeam && (player.gone || !player.connected);
      });
      record.line[rightTeam == game_.aLeft() ? "gone_b" : "gone_a"] = left;
    }
    record.times["timeouts"] = server_.statistics().timeouts;
    return record;
  }

  lab::SeriesGame game_;
  const lab::MatchSettings& match_;
  bool lockStep_;
  SideAgents& agents_;
  const std::function<bool(double)>& goOn_;
  lab::MatchWatcher watcher_;
  lab::SimulationFrames frames_;
  lab::MatchStatistics statistics_;
  std::array<int, 2> score_{};
  sim::Server server_;
  // Of the server's thread and of the watching one, which may both find some in the first cycle; read after
  // both.
  std::string trouble_;
  std::string startTrouble_;
  std::atomic<bool> begun_{false};
};

}  // namespace

std::optional<ServerPlace> serverPlace(const std::string& place) {
  if (lab::playedHere(place)) return std::nullopt;
  const std::size_t last = place.rfind(':');
  const std::size_t middle = last == std::string::npos || last == 0 ? last : place.rfind(':', last - 1);
  ServerPlace server;
  const bool two = middle != std::string::npos && middle > 0 && middle < last;
  if (two && place.find(':') == middle) {
    server.host = place.substr(0, middle);
    server.port = portFrom(std::string_view(place).substr(middle + 1, last - middle - 1)).value_or(0);
    server.monitorPort = portFrom(std::string_view(place).substr(last + 1)).value_or(0);
  }
  if (server.port == 0 || server.monitorPort == 0)
    throw std::runtime_error(fmt::format(
        "'{}': expected process, tcp, realtime, or HOST:PORT:MONITORPORT such as localhost:3100:3200",
        place));
  return server;
}

lab::PlayGame gamesOfProcesses(const lab::SeriesSettings& settings, const std::string& folder,
                               const std::string& dataFolder, const SayLine& say) {
  const auto programs = std::make_shared<SideAgents::Programs>(settings);
  return [settings, folder, dataFolder, programs, say](const lab::SeriesGame& game,
                                                       const std::function<bool(double)>& goOn) {
    const auto start = Clock::now();
    lab::MatchSettings match = lab::matchOf(settings, game, folder);
    const std::string logs =
        fs::absolute(fmt::format("{}/games/{}-{}", folder, game.pair, game.game)).string();
    fs::create_directories(logs);
    SideAgents agents(settings, game, *programs, match, dataFolder, logs);
    lab::GameRecord record = serverPlace(settings.place)
                                 ? playOnServer(settings, game, match, agents, goOn, logs, say)
                                 : TcpGame(game, match, settings.place != "realtime", agents, goOn).play();
    agents.addTo(record);
    record.times["wall_time_s"] = std::chrono::duration<double>(Clock::now() - start).count();
    // What agents say matters only if something went wrong; that throws above.
    const bool well = record.line["crashed_a"] == 0 && record.line["crashed_b"] == 0;
    if (well) fs::remove_all(logs);
    return record;
  };
}

}  // namespace nonet::app
