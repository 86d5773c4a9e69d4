// Follows the monitor port of a running server, ours or the league's, into a track.
#pragma once

#include <string>

#include <asio/io_context.hpp>
#include <asio/ip/tcp.hpp>
#include <asio/steady_timer.hpp>

#include "nonet/app/view/track.h"
#include "nonet/protocol/framing.h"

namespace nonet::app {

class LiveMonitor {
 public:
  /// Connects while `io` runs, and again whenever the connection is lost. The track must outlive this.
  LiveMonitor(asio::io_context& io, std::string host, std::string port, Track& track);

  /// For people: "live from localhost:3200", "waiting for ...".
  const std::string& state() const { return state_; }

 private:
  void connect();
  void retry();
  void read();
  void take();
  void say(std::string state);

  std::string host_;
  std::string port_;
  Track& track_;
  asio::ip::tcp::resolver resolver_;
  asio::ip::tcp::socket socket_;
  asio::steady_timer timer_;
  protocol::FrameReader frames_;
  protocol::MonitorReader reader_;
  std::string state_;
};

}  // namespace nonet::app
