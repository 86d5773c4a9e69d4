// How agents come to the server: connections, their messages, and the lobby before a reproducible match.
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "sim/server/server_implementation.h"

namespace nonet::sim {

namespace {

// Of equal effectors the last one counts (of what is said also the first), as within one message.
void mergeInto(protocol::Effectors& earlier, const protocol::Effectors& later) {
  if (later.scene) earlier.scene = later.scene;
  if (later.init) earlier.init = later.init;
  if (later.beam) earlier.beam = later.beam;
  if (later.firstSay) earlier.addSay(*later.firstSay);
  if (later.say) earlier.addSay(*later.say);
  for (std::size_t i = 0; i < model::kJointCount; ++i) {
    if (later.hasSpeed(model::jointAt(i))) earlier.setSpeed(model::jointAt(i), later.speeds[i]);
  }
  earlier.pass = earlier.pass || later.pass;
  earlier.syn = earlier.syn || later.syn;
}

}  // namespace

void Server::Implementation::acceptAgents() {
  agentAcceptor.async_accept([this](std::error_code error, asio::ip::tcp::socket socket) {
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
      return acceptAgain.start([this] { acceptAgents(); });
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
  link.heard = SteadyClock::now();
  if (skipped > 0 && link.skipped == 0) {
    spdlog::warn("server: {} sends what is no command (ignored, said once)", describe(link));
  }
  link.skipped += skipped;
  statistics.skippedExpressions += skipped;
  if (link.lobby) return lobbyMessage(link, effectors);
  if (serverSettings.realTime && effectors.syn && !link.hasAnswered() && link.sensesSent > 0)
    statistics.answers.add(Seconds(link.heard - link.sensed).count());
  if (link.inbox.size() < kMaxQueuedMessages) {
    link.inbox.push_back({effectors, link.sensesSent});
  } else {
    // Reading must go on, or the answer, and the end of the connection, would hide behind a flood.
    mergeInto(link.inbox.back().effectors, effectors);
    link.inbox.back().afterSense = link.sensesSent;
  }
}

long Server::Implementation::readyPlayers() const {
  return std::count_if(agents.begin(), agents.end(),
                       [](const auto& link) { return link->lobby && link->lobby->ready(); });
}

void Server::Implementation::lobbyMessage(AgentLink& link, const protocol::Effectors& message) {
  const bool wasReady = link.lobby->ready();
  if (const protocol::Percept* answer = link.lobby->receive(message)) sendSense(link, *answer);
  if (wasReady || !link.lobby->ready()) return;
  spdlog::info("server: {} of {} players are there", readyPlayers(), serverSettings.players);
}

void Server::Implementation::waitInLobby() {
  io.run_one_for(std::chrono::milliseconds(100));
  handleWhatIsReady();
  readOn();
  reap();
  executeTrainerCommands();
  if (readyPlayers() >= serverSettings.players) startMatch();
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
      link->held = true;
      link->sensesSent = 0;  // those of the lobby: the robot is yet to be born
    }
    link->lobby.reset();
  }
  spdlog::info("server: the match starts with {} players", ready.size());
  cycleBegan = SteadyClock::now();
}

}  // namespace nonet::sim
