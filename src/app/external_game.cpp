// A game on a server that is not in this process: the league's, or ours started apart. It is followed and
// kicked off through its monitor port (server facts 5.1, 5.5), and counted from its monitor stream alone.
#include <chrono>
#include <stdexcept>
#include <thread>

#include <asio.hpp>
#include <fmt/format.h>

#include "nonet/app/series_games.h"
#include "nonet/lab/match/frame_sources.h"
#include "nonet/protocol/framing.h"

namespace nonet::app {
namespace {

using asio::ip::tcp;
using Clock = std::chrono::steady_clock;
using protocol::PlayMode;

constexpr double kLongestStart = 90.0;    // s until the server, then each team, must be there
constexpr double kUsualStart = 5.0;       // s that a server of --server-command takes
constexpr double kLongestSilence = 30.0;  // s without a message of the server
constexpr double kFarewell = 3.0;         // s for the field to become empty

double secondsSince(Clock::time_point time) {
  return std::chrono::duration<double>(Clock::now() - time).count();
}

// The monitor port, read message by message.
class MonitorLink {
 public:
  // Tries until somebody listens or the time is over. What it waits for it says after `patience` seconds.
  MonitorLink(const ServerPlace& server, double patience, const SayLine& say,
              const std::function<bool()>& goOn) {
    const auto start = Clock::now();
    for (bool said = false;;) {
      std::error_code error;
      tcp::resolver resolver(io_);
      const auto endpoints = resolver.resolve(server.host, std::to_string(server.monitorPort), error);
      if (!error) asio::connect(socket_, endpoints, error);
      if (!error) return;
      if (!goOn()) throw std::runtime_error("stopped");
      if (secondsSince(start) > kLongestStart)
        throw std::runtime_error(fmt::format("no server at {}, monitor port {}: {}", server.host,
                                             server.monitorPort, error.message()));
      if (!said && secondsSince(start) >= patience) {
        said = true;
        say(fmt::format("waiting up to {:.0f} s for a server at {}, monitor port {} ({})", kLongestStart,
                        server.host, server.monitorPort, error.message()));
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(200));
    }
  }

  void command(std::string_view text) {
    std::string bytes;
    protocol::appendFrame(bytes, text);
    std::error_code error;
    asio::write(socket_, asio::buffer(bytes), error);  // a server that has gone shows when it is read
  }

  // The next message that gives a frame. False: the server has gone.
  bool next() {
    for (;;) {
      while (const auto message = messages_.next()) {
        if (frames_.message(*message)) return true;
      }
      if (messages_.failed() || !receive()) return false;
    }
  }

  const lab::MonitorFrames& frames() const { return frames_; }

 private:
  bool receive() {
    constexpr std::size_t kReadSize = 1U << 16U;
    const auto room = messages_.prepare(kReadSize);
    std::error_code result = asio::error::would_block;
    std::size_t received = 0;
    socket_.async_read_some(asio::buffer(room.data(), room.size()),
                            [&](std::error_code error, std::size_t size) {
                              result = error;
                              received = size;
                            });
    io_.restart();
    io_.run_for(std::chrono::duration_cast<std::chrono::milliseconds>(
        std::chrono::duration<double>(kLongestSilence)));
    if (result == asio::error::would_block) {
      socket_.cancel();
      io_.restart();
      io_.run();
    }
    messages_.received(received);
    return !result && received > 0;
  }

  asio::io_context io_;
  tcp::socket socket_{io_};
  protocol::FrameReader messages_;
  lab::MonitorFrames frames_;
};

class ExternalGame {
 public:
  ExternalGame(const ServerPlace& server, const lab::SeriesSettings& settings, const lab::SeriesGame& game,
               lab::MatchSettings& match, SideAgents& agents, const std::function<bool(double)>& goOn,
               const SayLine& say)
      : server_(server),
        settings_(settings),
        game_(game),
        match_(match),
        agents_(agents),
        goOn_(goOn),
        link_(server, settings.serverCommand.empty() ? 0.0 : kUsualStart, say, [&] { return goOn(0.0); }) {}

  lab::GameRecord play() {
    follow();
    takeNames();
    // A server that goes on after a game begins again; its clock's halves do not matter then, since the
    // length of the game is ours.
    if (link_.frames().frame().mode != PlayMode::BeforeKickOff || link_.frames().frame().time > 0.0)
      link_.command("(playMode BeforeKickOff)(time 0)(score (left 0)(right 0))(reqfullstate)");
    for (const bool rightTeam : {false, true}) {
      agents_.start(rightTeam, server_, false);
      awaitTeam(rightTeam);
    }
    pauseBeforeKickOff();
    link_.command("(kickOff Left)");
    playOn();
    lab::GameRecord record = collect();
    agents_.stop(0.0);  // most servers do not end with the game
    awaitEmptyField();
    return record;
  }

 private:
  // To the next frame.
  void follow() {
    if (!link_.next()) throw std::runtime_error("the server has gone, or has been silent for 30 s");
  }

  // A server keeps the names of its teams until it ends: whoever plays there next goes by them.
  void takeNames() {
    const protocol::MonitorGame& game = link_.frames().game();
    if (!game.teamLeft.empty()) match_.left.name = game.teamLeft;
    if (!game.teamRight.empty()) match_.right.name = game.teamRight;
  }

  // On that server's field.
  lab::MatchStatistics& statistics() {
    if (!statistics_) statistics_.emplace(link_.frames().field());
    return *statistics_;
  }

  int playersOf(bool rightTeam) const {
    int count = 0;
    const lab::Frame& frame = link_.frames().frame();
    for (const lab::FrameRobot& robot : frame.robots)
      count += ((robot.team == 1) != frame.swapped) == rightTeam ? 1 : 0;
    return count;
  }

  void awaitTeam(bool rightTeam) {
    const auto start = Clock::now();
    const lab::TeamSettings& team = rightTeam ? match_.right : match_.left;
    while (playersOf(rightTeam) < team.players) {
      follow();
      std::string trouble = agents_.trouble();
      if (trouble.empty() && secondsSince(start) > kLongestStart)
        trouble = fmt::format("{} of {} players of team {} came within {} s", playersOf(rightTeam),
                              team.players, team.name, kLongestStart);
      if (!trouble.empty()) throw std::runtime_error(trouble);
      if (!goOn_(0.0)) throw std::runtime_error("stopped");
    }
  }

  // So that everybody can take its place.
  void pauseBeforeKickOff() {
    const auto start = Clock::now();
    while (secondsSince(start) < settings_.kickOffWait) follow();
  }

  void playOn() {
    const double end = 60.0 * settings_.minutes;
    Clock::time_point played = Clock::now();  // last: the second half waits for its kick-off since then
    bool begun = false;
    for (;;) {
      follow();
      const lab::Frame& frame = link_.frames().frame();
      begun = begun || frame.mode != PlayMode::BeforeKickOff;
      if (begun) statistics().add(frame);
      if (frame.mode == PlayMode::GameOver || frame.time >= end) return;
      if (!goOn_(frame.time)) return;
      if (frame.robots.empty()) throw std::runtime_error("all players have left");
      if (!begun || frame.mode != PlayMode::BeforeKickOff) {
        played = Clock::now();
      } else if (secondsSince(played) >= settings_.kickOffWait) {
        // The second half is for the team that did not begin. The server does not know who did, since we said
        // so ourselves: asked for the one whose turn it is it may take the left again (server facts 4.3).
        link_.command(frame.swapped ? "(kickOff Left)" : "(kickOff Right)");
        played = Clock::now();
      }
    }
  }

  lab::GameRecord collect() {
    const lab::Frame& frame = link_.frames().frame();
    const bool finished = frame.mode == PlayMode::GameOver || frame.time >= 60.0 * settings_.minutes;
    lab::GameRecord record = lab::gameRecord(game_, frame.score[0], frame.score[1], frame.time, finished);
    record.line["statistics"] = statistics().toJson();
    for (const bool rightTeam : {false, true}) {
      const lab::TeamSettings& team = rightTeam ? match_.right : match_.left;
      const int here = playersOf(rightTeam != frame.swapped);
      record.line[rightTeam == game_.aLeft() ? "gone_b" : "gone_a"] = std::max(0, team.players - here);
    }
    return record;
  }

  // Numbers are free for the next game only when their robots have gone.
  void awaitEmptyField() {
    const auto start = Clock::now();
    while (!link_.frames().frame().robots.empty() && secondsSince(start) < kFarewell && link_.next()) {
    }
  }

  const ServerPlace& server_;
  const lab::SeriesSettings& settings_;
  lab::SeriesGame game_;
  lab::MatchSettings& match_;
  SideAgents& agents_;
  const std::function<bool(double)>& goOn_;
  MonitorLink link_;
  std::optional<lab::MatchStatistics> statistics_;
};

}  // namespace

lab::GameRecord playOnServer(const lab::SeriesSettings& settings, const lab::SeriesGame& game,
                             lab::MatchSettings& match, SideAgents& agents,
                             const std::function<bool(double)>& goOn, const std::string& logs,
                             const SayLine& say) {
  const ServerPlace server = serverPlace(settings.place).value();
  AgentProcesses processes;
  if (!settings.serverCommand.empty()) {
    processes.startShell(
        filledIn(settings.serverCommand, {{"host", server.host},
                                          {"port", std::to_string(server.port)},
                                          {"monitor", std::to_string(server.monitorPort)},
                                          {"seed", std::to_string(game.seed)},
                                          {"half", fmt::format("{}", 30.0 * settings.minutes)}}),
        logs + "/server.txt");
  }
  lab::GameRecord record = ExternalGame(server, settings, game, match, agents, goOn, say).play();
  processes.stop(0.0);
  return record;
}

}  // namespace nonet::app
