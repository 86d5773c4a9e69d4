// A server that does exactly what a test tells it, on a port of its own. All calls block; reading gives up
// after five seconds.
#pragma once

#include <array>
#include <chrono>
#include <optional>
#include <string>

#include <asio.hpp>
#include <poll.h>

#include "nonet/protocol/framing.h"

namespace nonet::app {

/// A port on which nobody listens, and which nobody else can get meanwhile.
class ClosedPort {
 public:
  ClosedPort() {
    acceptor_.open(asio::ip::tcp::v4());
    acceptor_.bind({asio::ip::address_v4::loopback(), 0});
  }
  int port() const { return acceptor_.local_endpoint().port(); }
  /// Now somebody does: the server has come. Returns when a client has; says one thing and closes that
  /// connection.
  void acceptAndClose() {
    acceptor_.listen();
    asio::ip::tcp::socket socket = acceptor_.accept();
    std::array<char, 1024> greeting{};
    socket.read_some(asio::buffer(greeting));
    std::string frame;
    protocol::appendFrame(frame, "(time (now 1.00))");
    asio::write(socket, asio::buffer(frame));
  }

 private:
  asio::io_context io_;
  asio::ip::tcp::acceptor acceptor_{io_};
};

class FakeServer {
 public:
  FakeServer() : acceptor_(io_, {asio::ip::address_v4::loopback(), 0}), socket_(io_) {}

  int port() const { return acceptor_.local_endpoint().port(); }

  /// Whether somebody has come within `seconds`, for accept().
  bool waits(double seconds) {
    pollfd descriptor{acceptor_.native_handle(), POLLIN, 0};
    return ::poll(&descriptor, 1, static_cast<int>(seconds * 1000)) > 0;
  }
  void accept() {
    frames_.reset();
    socket_ = acceptor_.accept();
    socket_.set_option(asio::ip::tcp::no_delay(true));
  }

  void send(const std::string& message) {
    std::string frame;
    protocol::appendFrame(frame, message);
    sendRaw(frame);
  }
  void sendRaw(const std::string& bytes) { asio::write(socket_, asio::buffer(bytes)); }

  /// The next message, nothing when the peer has closed or stays silent for `patience` seconds.
  std::optional<std::string> receive(double patience = 5.0) {
    for (;;) {
      if (const auto message = frames_.next()) return std::string(*message);
      pollfd descriptor{socket_.native_handle(), POLLIN, 0};
      if (::poll(&descriptor, 1, static_cast<int>(patience * 1000)) <= 0) return std::nullopt;
      const std::span<char> room = frames_.prepare(4096);
      std::error_code error;
      const std::size_t count = socket_.read_some(asio::buffer(room.data(), room.size()), error);
      if (error) return std::nullopt;
      frames_.received(count);
    }
  }

  void close() { socket_.close(); }

 private:
  asio::io_context io_;
  asio::ip::tcp::acceptor acceptor_;
  asio::ip::tcp::socket socket_;
  protocol::FrameReader frames_;
};

/// A sense message of a standing robot at server time `time`; `status` goes into GS.
inline std::string standingMessage(double time, const std::string& status = "") {
  char clock[32];
  std::snprintf(clock, sizeof clock, "%.2f", time);
  return "(time (now " + std::string(clock) + "))(GS " + status +
         "(sl 0) (sr 0) (t 0.00) (pm BeforeKickOff))(GYR (n torso) (rt 0.00 0.00 0.00))"
         "(ACC (n torso) (a 0.00 0.00 9.81))(HJ (n hj1) (ax 0.00))(HJ (n hj2) (ax 0.00))"
         "(HJ (n rlj3) (ax 10.00))(FRP (n rf) (c 0.00 0.00 -0.01) (f 0.00 0.00 22.59))"
         "(FRP (n lf) (c 0.00 0.00 -0.01) (f 0.00 0.00 22.59))";
}

}  // namespace nonet::app
