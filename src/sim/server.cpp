#include "nonet/sim/server.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <deque>
#include <vector>

#include <asio/executor_work_guard.hpp>
#include <asio/io_context.hpp>
#include <asio/ip/tcp.hpp>
#include <asio/post.hpp>
#include <asio/signal_set.hpp>
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "nonet/protocol/percept_text.h"
#include "nonet/sim/monitor.h"
#include "nonet/sim/server_lobby.h"

#include "server_connection.h"
#include "server_monitors.h"

namespace nonet::sim {

namespace {

using Clock = std::chrono::steady_clock;
using asio::ip::tcp;

constexpr auto kCycle = std::chrono::milliseconds(20);
constexpr std::chrono::seconds kSilence{2};  // after which an agent counts as silent

// Of equal effectors the last one counts, as within one message.
void mergeInto(protocol::Effectors& earlier, const protocol::Effectors& later) {
  if (later.scene) earlier.scene = later.scene;
  if (later.init) earlier.init = later.init;
  if (later.beam) earlier.beam = later.beam;
  if (later.say) earlier.say = later.say;
  for (std::size_t i = 0; i < model::kJointCount; ++i) {
    if (later.hasSpeed(model::jointAt(i))) earlier.setSpeed(model::jointAt(i), later.speeds[i]);
  }
  earlier.pass = earlier.pass || later.pass;
  earlier.syn = earlier.syn || later.syn;
}

// An agent's connection.
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
  bool owesAnswer = false;  // lock-step: to the last sense message
  bool givenUp = false;     // lock-step: not waited for
  long dropped = 0;         // messages in a row
  Clock::time_point heard = Clock::now();
  bool silent = false;  // not heard for kSilence, and said so
  int skipped = 0;

  bool hasAnswered() const {
    return std::any_of(inbox.begin(), inbox.end(), [this](const Received& received) {
      return received.effectors.syn && received.afterSense == sensesSent;
    });
  }
};

}  // namespace

struct Server::Implementation {
  Implementation(const Settings& settings, std::uint64_t seed, const ServerOptions& o);

  void acceptAgents();
  void agentMessage(AgentLink& link, std::string_view text);
  void lobbyMessage(AgentLink& link, const protocol::Effectors& message);
  void waitInLobby();
  void startMatch();
  std::string describe(const AgentLink& link) const;

  void cycle();
  void pace();
  void waitForAnswers();
  void giveUpWaiting();
  void deliverCommands();
  void sendSenses();
  void sendSense(AgentLink& link, const protocol::Percept& percept);
  void noticeSilence();
  void reap();
  void executeTrainerCommands();
  bool matchIsOver();

  ServerOptions options;
  std::uint64_t seed;
  Simulation simulation;
  asio::io_context io;
  asio::executor_work_guard<asio::io_context::executor_type> work;
  tcp::acceptor agentAcceptor;
  Admission admission;
  Monitors monitors;
  asio::signal_set signals;
  std::vector<std::unique_ptr<AgentLink>> agents;
  std::optional<MonitorLog> log;
  std::function<void(const Simulation&)> callback;
  Statistics statistics;
  std::atomic<bool> stopping{false};
  bool lobbyOpen = false;
  Clock::time_point nextCycle = Clock::now();
  long cycles = 0;
  long cyclesAfterEnd = 0;
  std::string text;  // reused
};

Server::Implementation::Implementation(const Settings& settings, std::uint64_t s, const ServerOptions& o)
    : options(o),
      seed(s),
      simulation(settings, s),
      work(asio::make_work_guard(io)),
      agentAcceptor(listenOn(io, o.address, o.agentPort, "agents")),
      admission(o.mostConnections, o.mostPerAddress),
      monitors(io, simulation, o.address, o.monitorPort, Admission(o.mostConnections, o.mostPerAddress)),
      signals(io),
      lobbyOpen(o.players > 0) {
  if (!o.monitorLog.empty()) log.emplace(simulation, o.monitorLog);
  if (o.handleSignals) {
    signals.add(SIGINT);
    signals.add(SIGTERM);
    signals.async_wait([this](std::error_code error, int signal) {
      if (error) return;
      spdlog::info("server: ends on signal {}", signal);
      stopping = true;
    });
  }
  acceptAgents();
}

void Server::Implementation::acceptAgents() {
  agentAcceptor.async_accept([this](std::error_code error, tcp::socket socket) {
    if (error == asio::error::operation_aborted) return;
    if (!error) {
      auto link = std::make_unique<AgentLink>();
      link->connection = std::make_shared<Connection>(std::move(socket));
      if (!admission.admits(agents, *link->connection, "agent")) {
        link->connection->close();
        ++statistics.refused;
        return acceptAgents();
      }
      AgentLink& added = *link;
      agents.push_back(std::move(link));
      ++statistics.accepted;
      if (lobbyOpen) {
        added.lobby = std::make_unique<Lobby>(simulation.settings(), seed);
      } else {
        added.agent = simulation.connect();
      }
      spdlog::info("server: {} connected", describe(added));
      added.connection->start([this, &added](std::string_view message) { agentMessage(added, message); },
                              [] { return false; });
    } else {
      spdlog::warn("server: could not accept an agent: {}", error.message());
    }
    acceptAgents();
  });
}

std::string Server::Implementation::describe(const AgentLink& link) const {
  for (const AgentInfo& info : simulation.agents()) {
    if (info.handle == link.agent && info.unum != 0) {
      return fmt::format("player {} of {} ({})", info.unum, std::string_view(info.team),
                         link.connection->peer());
    }
  }
  return fmt::format("agent {}", link.connection->peer());
}

void Server::Implementation::agentMessage(AgentLink& link, std::string_view message) {
  protocol::Effectors effectors;
  const int skipped = protocol::parseEffectors(message, effectors);
  if (link.silent) spdlog::info("server: {} sends again", describe(link));
  link.silent = false;
  link.heard = Clock::now();
  if (skipped > 0 && link.skipped == 0) {
    spdlog::warn("server: {} sends what is no command (ignored, said once)", describe(link));
  }
  link.skipped += skipped;
  statistics.skippedExpressions += skipped;
  if (link.lobby) return lobbyMessage(link, effectors);
  if (link.inbox.size() < kMaxQueuedMessages) {
    link.inbox.push_back({effectors, link.sensesSent});
  } else {
    // Reading must go on, or the answer, and the end of the connection, would hide behind a flood.
    mergeInto(link.inbox.back().effectors, effectors);
    link.inbox.back().afterSense = link.sensesSent;
  }
}

void Server::Implementation::lobbyMessage(AgentLink& link, const protocol::Effectors& message) {
  const bool wasReady = link.lobby->ready();
  if (const protocol::Percept* answer = link.lobby->receive(message)) sendSense(link, *answer);
  if (wasReady || !link.lobby->ready()) return;
  const auto ready = std::count_if(agents.begin(), agents.end(),
                                   [](const auto& a) { return a->lobby && a->lobby->ready(); });
  spdlog::info("server: {} of {} players are there", ready, options.players);
}

void Server::Implementation::waitInLobby() {
  io.run_one_for(std::chrono::milliseconds(100));
  io.poll();
  reap();
  executeTrainerCommands();
  const auto ready = std::count_if(agents.begin(), agents.end(),
                                   [](const auto& a) { return a->lobby && a->lobby->ready(); });
  if (ready >= options.players) startMatch();
}

void Server::Implementation::startMatch() {
  lobbyOpen = false;
  std::vector<AgentLink*> ready;
  std::vector<protocol::InitEffector> inits;
  for (const auto& link : agents) {
    if (!link->lobby->ready()) continue;
    ready.push_back(link.get());
    inits.push_back(*link->lobby->init());
  }
  for (const std::size_t i : entryOrder(simulation.settings(), inits)) {
    AgentLink& link = *ready[i];
    link.agent = simulation.enter(*link.lobby->scene(), *link.lobby->init());
    link.lobby.reset();
    link.sensesSent = 0;
  }
  for (const auto& link : agents) {
    if (!link->lobby) continue;
    // Came too late for the start: an ordinary agent from now on.
    link->agent = simulation.connect();
    if (link->lobby->scene()) {
      protocol::Effectors scene;
      scene.scene = link->lobby->scene();
      link->inbox.push_back({scene, 0});
    }
    link->lobby.reset();
  }
  spdlog::info("server: the match starts with {} players", ready.size());
  nextCycle = Clock::now();
}

// Server facts 1.2.
void Server::Implementation::cycle() {
  pace();
  if (options.lockStep) waitForAnswers();
  if (stopping) return;
  executeTrainerCommands();
  deliverCommands();
  simulation.beginCycle();
  sendSenses();
  simulation.finishCycle();
  ++cycles;
  noticeSilence();
  reap();
  if (cycles % 2 == 0) statistics.droppedMessages += monitors.sendMessages();
  if (log) log->cycle();
  if (callback) callback(simulation);
  if (!options.endWithMatch || !matchIsOver()) return;
  if (options.lockStep) waitForAnswers();  // nobody's last message is cut off by the end of the connection
  stopping = true;
}

void Server::Implementation::pace() {
  io.poll();
  // Lock-step without a robot has nobody to wait for; real time keeps it from running away.
  const bool idle =
      std::none_of(agents.begin(), agents.end(), [](const auto& link) { return link->sensesSent > 0; });
  if (!options.realTime && !(options.lockStep && idle)) {
    nextCycle = Clock::now();
    return;
  }
  nextCycle += kCycle;
  const auto now = Clock::now();
  if (nextCycle < now) nextCycle = now;  // time that is lost is not caught up
  while (!stopping && Clock::now() < nextCycle) io.run_one_until(nextCycle);
  io.poll();
}

void Server::Implementation::waitForAnswers() {
  const auto deadline = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                           std::chrono::duration<double>(options.answerTimeout));
  const auto allAnswered = [this] {
    return std::all_of(agents.begin(), agents.end(), [](const auto& link) {
      return !link->owesAnswer || link->givenUp || link->connection->dead() || link->hasAnswered();
    });
  };
  while (!stopping && !allAnswered()) {
    if (io.run_one_until(deadline) == 0) giveUpWaiting();
  }
}

void Server::Implementation::giveUpWaiting() {
  for (const auto& link : agents) {
    if (!link->owesAnswer || link->givenUp || link->connection->dead() || link->hasAnswered()) continue;
    link->givenUp = true;
    ++statistics.timeouts;
    spdlog::warn("server: {} has not answered for {} s: the match goes on without waiting for it",
                 describe(*link), options.answerTimeout);
  }
}

void Server::Implementation::deliverCommands() {
  for (const auto& link : agents) {
    if (link->agent == kNoAgent) continue;
    // In lock-step a cycle takes exactly what belongs to the answer, however fast the rest arrives.
    bool more = true;
    while (more && !link->inbox.empty()) {
      const AgentLink::Received& received = link->inbox.front();
      if (received.effectors.syn && received.afterSense == link->sensesSent) {
        if (link->givenUp) spdlog::info("server: {} answers again", describe(*link));
        link->givenUp = false;
        more = !options.lockStep || !link->owesAnswer;
        link->owesAnswer = false;
      }
      simulation.actAsReceived(link->agent, received.effectors);
      link->inbox.pop_front();
    }
  }
}

void Server::Implementation::sendSenses() {
  for (const auto& link : agents) {
    if (const protocol::Percept* percept = simulation.sense(link->agent)) sendSense(*link, *percept);
  }
}

void Server::Implementation::sendSense(AgentLink& link, const protocol::Percept& percept) {
  if (link.connection->dead()) return;
  protocol::writePercept(percept, text);
  if (link.connection->send(text)) {
    if (link.dropped > 0)
      spdlog::info("server: {} reads again, it lost {} messages", describe(link), link.dropped);
    link.dropped = 0;
    ++link.sensesSent;
    link.owesAnswer = options.lockStep && !link.lobby;
    return;
  }
  if (link.connection->dead()) return;
  ++statistics.droppedMessages;
  if (++link.dropped == 1) spdlog::warn("server: {} reads too slowly and loses messages", describe(link));
}

// In lock-step nobody can be silent unnoticed. By the clock the others play on; the log says who does not.
void Server::Implementation::noticeSilence() {
  if (options.lockStep) return;
  for (const auto& link : agents) {
    if (link->silent || link->sensesSent == 0 || Clock::now() - link->heard < kSilence) continue;
    link->silent = true;
    spdlog::warn("server: {} has sent nothing for {} s", describe(*link), kSilence.count());
  }
}

// Server facts 1.10, and robots that a trainer has removed.
void Server::Implementation::reap() {
  for (const auto& link : agents) {
    if (link->agent != kNoAgent && !link->connection->dead() && !simulation.isConnected(link->agent)) {
      link->connection->close();
    }
    if (!link->connection->dead()) continue;
    spdlog::info("server: {} is gone: {}", describe(*link), link->connection->reason());
    ++(link->connection->refused() ? statistics.refused : statistics.lost);
    simulation.disconnect(link->agent);
  }
  std::erase_if(agents, [](const auto& link) { return link->connection->dead(); });
  monitors.reap();
}

void Server::Implementation::executeTrainerCommands() {
  if (cycles % 2 != 0 || monitors.executeCommands()) return;
  spdlog::info("server: ends by a trainer's command");
  stopping = true;
}

bool Server::Implementation::matchIsOver() {
  if (simulation.match().playMode != protocol::PlayMode::GameOver) cyclesAfterEnd = 0;
  constexpr long kLinger = 50;  // cycles, so that everybody hears of the end
  return simulation.match().playMode == protocol::PlayMode::GameOver && ++cyclesAfterEnd > kLinger;
}

Server::Server(const Settings& settings, std::uint64_t seed, const ServerOptions& options)
    : implementation_(std::make_unique<Implementation>(settings, seed, options)) {}

Server::~Server() {
  for (const auto& link : implementation_->agents) link->connection->close();
  implementation_->monitors.closeAll();
}

std::uint16_t Server::agentPort() const {
  return implementation_->agentAcceptor.local_endpoint().port();
}
std::uint16_t Server::monitorPort() const {
  return implementation_->monitors.port();
}

void Server::run() {
  Implementation& self = *implementation_;
  self.nextCycle = Clock::now();
  while (!self.stopping) {
    if (self.lobbyOpen) {
      self.waitInLobby();
    } else {
      self.cycle();
    }
  }
  for (const auto& link : self.agents) link->connection->close();
  self.monitors.closeAll();
  self.agentAcceptor.close();
  self.monitors.stopAccepting();
  self.signals.cancel();
  self.io.poll();
}

void Server::stop() {
  implementation_->stopping = true;
  asio::post(implementation_->io, [] {});
}

void Server::onCycle(std::function<void(const Simulation&)> callback) {
  implementation_->callback = std::move(callback);
}

const Simulation& Server::simulation() const {
  return implementation_->simulation;
}

Server::Statistics Server::statistics() const {
  return implementation_->statistics;
}

}  // namespace nonet::sim
