// The inside of Server, shared by its source files.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <asio/executor_work_guard.hpp>
#include <asio/io_context.hpp>
#include <asio/ip/tcp.hpp>
#include <asio/signal_set.hpp>
#include <asio/steady_timer.hpp>

#include "nonet/sim/server/lobby.h"
#include "nonet/sim/server/monitor.h"
#include "nonet/sim/server/server.h"

#include "sim/server/accept_pause.h"
#include "sim/server/connection.h"
#include "sim/server/monitors.h"

namespace nonet::sim {

using SteadyClock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

/// An agent's connection.
struct AgentLink {
  std::shared_ptr<Connection> connection;
  AgentHandle agent = kNoAgent;  // none while in the lobby
  std::unique_ptr<Lobby> lobby;
  struct Received {
    protocol::Effectors effectors;
    long afterSense = 0;  // how many sense messages had been sent when it came
  };
  std::deque<Received> inbox;
  long sensesSent = 0;
  SteadyClock::time_point sensed;  // when the last was sent
  bool owesAnswer = false;         // lock-step: to the last sense message
  bool givenUp = false;            // lock-step: not waited for
  bool held = false;               // its scene waits until others are born
  long dropped = 0;                // messages in a row
  SteadyClock::time_point heard = SteadyClock::now();
  bool silent = false;  // not heard for kSilence, and said so
  int skipped = 0;

  bool hasAnswered() const {
    return std::any_of(inbox.begin(), inbox.end(), [this](const Received& received) {
      return received.effectors.syn && received.afterSense == sensesSent;
    });
  }
};

struct Server::Implementation {
  Implementation(const Settings& settings, std::uint64_t seed, const ServerSettings& given);

  void acceptAgents();
  void agentMessage(AgentLink& link, std::string_view text);
  void lobbyMessage(AgentLink& link, const protocol::Effectors& message);
  void waitInLobby();
  void startMatch();
  long readyPlayers() const;
  std::string describe(const AgentLink& link) const;

  void cycle();
  void pace();
  bool nobodyIsWaitedFor() const;
  void handleWhatIsReady();
  void readOn();
  void waitForAnswers();
  void giveUpWaiting();
  void deliverCommands();
  bool mustWaitToBeBorn(const AgentLink& link);
  void sendSenses();
  void sendSense(AgentLink& link, const protocol::Percept& percept);
  void noticeSilence();
  void reap();
  void executeTrainerCommands();
  bool matchIsOver();
  void watchLog();

  ServerSettings serverSettings;
  std::uint64_t seed;
  Simulation simulation;
  asio::io_context io;
  asio::executor_work_guard<asio::io_context::executor_type> work;
  asio::ip::tcp::acceptor agentAcceptor;
  AcceptPause acceptAgain;
  Admission admission;
  Monitors monitors;
  asio::signal_set signals;
  asio::steady_timer cycleTimer;
  std::vector<std::unique_ptr<AgentLink>> agents;
  std::optional<MonitorLog> log;
  bool toldOfLog = false;
  std::function<void(const Simulation&)> callback;
  Statistics statistics;
  std::atomic<bool> stopping{false};
  bool lobbyOpen = false;
  SteadyClock::time_point cycleBegan = SteadyClock::now();
  long cycles = 0;
  long cyclesAfterEnd = 0;
  AgentHandle newborn = kNoAgent;  // whose robot was built last
  long bornAt = 0;                 // cycle
  std::string text;                // reused
};

}  // namespace nonet::sim
