// The server's side of monitors and trainers: who is connected, what they are sent (server facts 5.1), and
// the commands that they send (5.5).
#pragma once

#include <deque>
#include <memory>
#include <string>
#include <vector>

#include <asio/io_context.hpp>
#include <asio/ip/tcp.hpp>

#include "nonet/sim/server/monitor.h"
#include "nonet/sim/simulation.h"

#include "sim/server/accept_pause.h"
#include "sim/server/connection.h"

namespace nonet::sim {

class Monitors {
 public:
  /// Listens on this port and accepts whoever comes, as far as `admission` allows, while `io` runs. Both
  /// references must outlive this.
  Monitors(asio::io_context& io, Simulation& simulation, const std::string& address, std::uint16_t port,
           const Admission& admission);
  Monitors(const Monitors&) = delete;
  Monitors& operator=(const Monitors&) = delete;

  std::uint16_t port() const { return acceptor_.local_endpoint().port(); }
  /// Runs the commands that have come. False if one of them ends the simulation.
  bool executeCommands();
  /// Sends everybody the next message of the stream. How many were lost because somebody reads too slowly.
  int sendMessages();
  /// Forgets connections that are dead.
  void reap();
  void closeAll();
  void stopAccepting() {
    acceptAgain_.cancel();
    acceptor_.close();
  }

 private:
  struct Link {
    std::shared_ptr<Connection> connection;
    std::deque<std::string> commands;
    bool needsFull = true;
  };

  void accept();

  Simulation& simulation_;
  asio::ip::tcp::acceptor acceptor_;
  AcceptPause acceptAgain_;
  Admission admission_;
  std::vector<std::unique_ptr<Link>> links_;
  MonitorStream stream_;
};

}  // namespace nonet::sim
