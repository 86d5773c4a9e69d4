#include "nonet/sim/server/server.h"

#include <algorithm>
#include <utility>

#include <asio/post.hpp>
#include <spdlog/spdlog.h>

#include "nonet/protocol/percept_text.h"

#include "sim/server/server_implementation.h"

namespace nonet::sim {

namespace {

const auto kCycle = std::chrono::round<SteadyClock::duration>(Seconds(kCycleTime));
constexpr double kLongestTimeout = 1e9;      // s; ten times as much does not fit into the clock's nanoseconds
constexpr std::chrono::seconds kSilence{2};  // after which an agent counts as silent

}  // namespace

Server::Implementation::Implementation(const Settings& settings, std::uint64_t s, const ServerSettings& given)
    : serverSettings(given),
      seed(s),
      simulation(settings, s),
      work(asio::make_work_guard(io)),
      agentAcceptor(listenOn(io, given.address, given.agentPort, "agents")),
      acceptAgain(io),
      admission(given.mostConnections, given.mostPerAddress),
      monitors(io, simulation, given.address, given.monitorPort,
               Admission(given.mostConnections, given.mostPerAddress)),
      signals(io),
      cycleTimer(io),
      lobbyOpen(given.players > 0) {
  if (!given.monitorLog.empty()) log.emplace(simulation, given.monitorLog);
  if (given.handleSignals) {
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

// Server facts 1.2.
void Server::Implementation::cycle() {
  pace();
  if (serverSettings.lockStep) waitForAnswers();
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
  watchLog();
  if (callback) callback(simulation);
  if (!serverSettings.endWithMatch || !matchIsOver()) return;
  // Nobody's last message is cut off by the end of the connection.
  if (serverSettings.lockStep) waitForAnswers();
  stopping = true;
}

// Server facts 1.2: a cycle begins no earlier than 20 ms after the one before, whatever that one lost.
void Server::Implementation::pace() {
  readOn();
  handleWhatIsReady();
  // Lock-step with nobody to wait for: real time keeps it from running away.
  const bool idle = nobodyIsWaitedFor();
  if (serverSettings.realTime || (serverSettings.lockStep && idle)) {
    // A timer, since waits of run_one_until() are rounded up to milliseconds.
    bool over = false;
    cycleTimer.expires_at(cycleBegan + kCycle);
    cycleTimer.async_wait([&over](std::error_code) { over = true; });
    while (!stopping && !over) io.run_one();
    cycleTimer.cancel();
    while (!over) io.run_one();
    handleWhatIsReady();
  }
  const SteadyClock::time_point before = std::exchange(cycleBegan, SteadyClock::now());
  if (serverSettings.realTime && !idle) statistics.delays.add(Seconds(cycleBegan - before - kCycle).count());
}

// No robot is there yet, or all have been given up.
bool Server::Implementation::nobodyIsWaitedFor() const {
  return std::none_of(agents.begin(), agents.end(),
                      [](const auto& link) { return link->sensesSent > 0 && !link->givenUp; });
}

// Not io.poll(): where somebody connects or sends without pause there is always more.
void Server::Implementation::handleWhatIsReady() {
  const auto end = SteadyClock::now() + kCycle / 4;
  while (!stopping && io.poll_one() > 0 && SteadyClock::now() < end) {
  }
}

void Server::Implementation::readOn() {
  for (const auto& link : agents) link->connection->resume();
}

void Server::Implementation::waitForAnswers() {
  const Seconds patience(std::min(serverSettings.answerTimeout, kLongestTimeout));
  const auto deadline = SteadyClock::now() + std::chrono::round<SteadyClock::duration>(patience);
  const auto allAnswered = [this] {
    return std::all_of(agents.begin(), agents.end(), [](const auto& link) {
      return !link->owesAnswer || link->givenUp || link->connection->dead() || link->hasAnswered();
    });
  };
  // An answer may lie behind more than one share.
  auto nextShare = SteadyClock::now() + kCycle;
  while (!stopping && !allAnswered()) {
    if (io.run_one_until(std::min(deadline, nextShare)) > 0) continue;
    if (SteadyClock::now() >= deadline) giveUpWaiting();
    readOn();
    nextShare = SteadyClock::now() + kCycle;
  }
}

void Server::Implementation::giveUpWaiting() {
  for (const auto& link : agents) {
    if (!link->owesAnswer || link->givenUp || link->connection->dead() || link->hasAnswered()) continue;
    link->givenUp = true;
    ++statistics.timeouts;
    spdlog::warn("server: {} has not answered for {} s: the match goes on without waiting for it",
                 describe(*link), serverSettings.answerTimeout);
  }
}

void Server::Implementation::deliverCommands() {
  for (const auto& link : agents) {
    if (link->agent == kNoAgent) continue;
    const bool waits = mustWaitToBeBorn(*link);
    link->held = link->held || waits;
    // In lock-step a cycle takes exactly what belongs to the answer, however fast the rest arrives.
    bool more = true;
    while (more && !link->inbox.empty()) {
      const AgentLink::Received& received = link->inbox.front();
      if (waits && received.effectors.scene) break;
      if (received.effectors.syn && received.afterSense == link->sensesSent) {
        if (link->givenUp) spdlog::info("server: {} answers again", describe(*link));
        link->givenUp = false;
        more = !serverSettings.lockStep || !link->owesAnswer;
        link->owesAnswer = false;
      }
      // What came while it was held is meant for the robot, which is there in the next cycle.
      if (received.effectors.scene && std::exchange(link->held, false)) more = false;
      simulation.actAsReceived(link->agent, received.effectors);
      link->inbox.pop_front();
    }
  }
}

// Every robot is built at the same place and moved by its init (server facts 1.3). Some that are built in the
// same cycle stand in each other, and their contacts take the physics seconds per cycle, for all: each waits
// until the one before has its place, or has had time to get it.
bool Server::Implementation::mustWaitToBeBorn(const AgentLink& link) {
  constexpr long kPatience = 10;  // cycles; a handshake takes five
  if (link.sensesSent > 0 || link.agent == newborn) return false;
  const bool asks =
      std::any_of(link.inbox.begin(), link.inbox.end(),
                  [](const AgentLink::Received& received) { return received.effectors.scene.has_value(); });
  if (!asks) return false;
  if (newborn != kNoAgent && cycles - bornAt < kPatience) {
    for (const AgentInfo& info : simulation.agents()) {
      if (info.handle == newborn && info.unum == 0) return true;
    }
  }
  newborn = link.agent;
  bornAt = cycles;
  return false;
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
    link.sensed = SteadyClock::now();
    link.owesAnswer = serverSettings.lockStep && !link.lobby;
    return;
  }
  if (link.connection->dead()) return;
  ++statistics.droppedMessages;
  if (++link.dropped == 1) spdlog::warn("server: {} reads too slowly and loses messages", describe(link));
}

// In lock-step nobody can be silent unnoticed. By the clock the others play on; the log says who does not.
void Server::Implementation::noticeSilence() {
  if (serverSettings.lockStep) return;
  for (const auto& link : agents) {
    if (link->silent || link->sensesSent == 0 || SteadyClock::now() - link->heard < kSilence) continue;
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

// A full disk does not end a match, but is said when it happens.
void Server::Implementation::watchLog() {
  if (!log || !log->failed() || std::exchange(toldOfLog, true)) return;
  spdlog::warn("server: {}", log->error());
}

Server::Server(const Settings& settings, std::uint64_t seed, const ServerSettings& serverSettings)
    : implementation_(std::make_unique<Implementation>(settings, seed, serverSettings)) {}

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
  self.cycleBegan = SteadyClock::now();
  while (!self.stopping) {
    if (self.lobbyOpen) {
      self.waitInLobby();
    } else {
      self.cycle();
    }
  }
  for (const auto& link : self.agents) link->connection->close();
  self.monitors.closeAll();
  self.acceptAgain.cancel();
  self.agentAcceptor.close();
  self.monitors.stopAccepting();
  self.signals.cancel();
  self.io.poll();
  if (self.log) self.log->close();
  self.watchLog();
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

std::string Server::recordingError() const {
  return implementation_->log ? implementation_->log->error() : "";
}

}  // namespace nonet::sim
