#include "sim/server/monitors.h"

#include <spdlog/spdlog.h>

namespace nonet::sim {

Monitors::Monitors(asio::io_context& io, Simulation& simulation, const std::string& address,
                   std::uint16_t port, const Admission& admission)
    : simulation_(simulation),
      acceptor_(listenOn(io, address, port, "monitors")),
      acceptAgain_(io),
      admission_(admission),
      stream_(simulation) {
  accept();
}

void Monitors::accept() {
  acceptor_.async_accept([this](std::error_code error, asio::ip::tcp::socket socket) {
    if (error == asio::error::operation_aborted) return;
    if (!error) {
      auto link = std::make_unique<Link>();
      link->connection = std::make_shared<Connection>(std::move(socket));
      if (!admission_.admits(links_, *link->connection, "monitor")) {
        link->connection->close();
        return accept();
      }
      Link& added = *link;
      links_.push_back(std::move(link));
      spdlog::info("server: monitor {} connected", added.connection->peer());
      // The only monitor starts the stream anew; others must not lose what they have.
      added.needsFull = !added.connection->send(links_.size() == 1 ? stream_.next(true) : stream_.full());
      added.connection->start([&added](std::string_view message) { added.commands.emplace_back(message); },
                              [&added] { return added.commands.size() >= kMaxQueuedMessages; });
    } else {
      spdlog::warn("server: could not accept a monitor: {}", error.message());
      return acceptAgain_.start([this] { accept(); });
    }
    accept();
  });
}

bool Monitors::executeCommands() {
  bool goesOn = true;
  for (const auto& link : links_) {
    while (!link->commands.empty()) {
      goesOn = simulation_.trainer(link->commands.front()) && goesOn;
      link->commands.pop_front();
    }
    link->connection->resume();
  }
  return goesOn;
}

int Monitors::sendMessages() {
  if (links_.empty()) return 0;
  const std::string& next = stream_.next();
  int lost = 0;
  bool somebodyLags = false;
  for (const auto& link : links_) {
    if (link->needsFull && !stream_.lastWasFull()) {
      somebodyLags = true;
      continue;
    }
    link->needsFull = !link->connection->send(next);
    if (link->needsFull) ++lost;
  }
  if (!somebodyLags) return lost;
  // A difference that was lost cannot be made good by later ones.
  const std::string& full = stream_.full();
  for (const auto& link : links_) {
    if (link->needsFull) link->needsFull = !link->connection->send(full);
  }
  return lost;
}

// Who sends a command and closes at once has it executed all the same.
void Monitors::reap() {
  const auto gone = [](const auto& link) { return link->connection->dead() && link->commands.empty(); };
  for (const auto& link : links_) {
    if (!gone(link)) continue;
    spdlog::info("server: monitor {} is gone: {}", link->connection->peer(), link->connection->reason());
  }
  std::erase_if(links_, gone);
}

void Monitors::closeAll() {
  for (const auto& link : links_) link->connection->close();
}

}  // namespace nonet::sim
