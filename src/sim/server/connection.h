// One TCP connection of the server: framed messages in, framed messages out, neither ever waiting.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include <asio/io_context.hpp>
#include <asio/ip/tcp.hpp>

#include "nonet/protocol/framing.h"

namespace nonet::sim {

/// Of one connection; more are merged (agents) or wait (monitors).
inline constexpr std::size_t kMaxQueuedMessages = 64;
/// Bytes that are read of one connection until the next resume(): a hundred times what an agent sends in a
/// cycle. So nobody who sends without pause holds up the others.
inline constexpr std::size_t kReadShare = 65536;

/// With address reuse. Throws std::runtime_error that names the port, and its purpose ("agents"), if it is
/// taken.
asio::ip::tcp::acceptor listenOn(asio::io_context& io, const std::string& address, std::uint16_t port,
                                 const char* purpose);

class Connection : public std::enable_shared_from_this<Connection> {
 public:
  explicit Connection(asio::ip::tcp::socket socket);

  /// Starts reading; `onMessage` gets every complete message, `paused` says when to stop reading for a while
  /// (then call resume()). resume() also gives it the next share.
  void start(std::function<void(std::string_view)> onMessage, std::function<bool()> paused);
  /// Goes on reading if it was paused and no longer is, or has read its share.
  void resume();
  /// Sends a message, or drops it whole while an earlier one has not gone out completely (server facts 1.1).
  /// False if it was dropped or the connection is dead.
  bool send(std::string_view message);
  void close();

  bool dead() const { return dead_; }
  /// Why it is dead: "" while it lives.
  const std::string& reason() const { return reason_; }
  /// Closed by us because of what it sent.
  bool refused() const { return refused_; }
  const std::string& peer() const { return peer_; }
  /// Of the peer, without its port.
  std::string address() const { return peer_.substr(0, peer_.rfind(':')); }

 private:
  void read();
  void deliver();
  void flush();
  void waitToFlush();
  void die(const std::string& reason);

  asio::ip::tcp::socket socket_;
  std::string peer_;
  protocol::FrameReader frames_;
  std::function<void(std::string_view)> onMessage_;
  std::function<bool()> paused_;
  std::size_t share_ = kReadShare;  // what may still be read
  bool reading_ = false;
  bool delivering_ = false;
  bool waitingToFlush_ = false;
  std::string out_;   // reused
  std::string rest_;  // of a message that has gone out in part
  bool dead_ = false;
  bool refused_ = false;
  std::string reason_;
};

/// How many connections of one kind may live, in all and from one address.
class Admission {
 public:
  Admission(int most, int mostPerAddress) : most_(most), mostPerAddress_(mostPerAddress) {}

  /// Whether one more may join `links`. Says the first refusal in a row.
  template <class Links>
  bool admits(const Links& links, const Connection& newcomer, const char* kind) {
    int all = 0;
    int same = 0;
    for (const auto& link : links) {
      if (link->connection->dead()) continue;
      ++all;
      same += link->connection->address() == newcomer.address() ? 1 : 0;
    }
    const bool admitted = all < most_ && same < mostPerAddress_;
    if (!admitted && !told_) tell(newcomer, kind);
    told_ = !admitted;
    return admitted;
  }

 private:
  void tell(const Connection& newcomer, const char* kind) const;

  int most_;
  int mostPerAddress_;
  bool told_ = false;
};

}  // namespace nonet::sim
