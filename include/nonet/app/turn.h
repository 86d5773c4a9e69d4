// Agents on one machine introduce themselves to a server one after the other: robots born in the same cycle
// overlap and are thrown apart, and ten at once stopped the reference server for good (server
// facts 1.3, 1.9).
#pragma once

#include <string>

#include <asio/ip/tcp.hpp>

namespace nonet::app {

/// The right to introduce oneself, held by at most one process of this user per server. Given back when the
/// process ends, however it ends.
class Turn {
 public:
  Turn() = default;
  ~Turn();
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;

  /// Where the server is. All addresses of this machine's own loop are one.
  void queueFor(const asio::ip::tcp::endpoint& server);
  /// Does not block. True as well where no lock file can be made, or before queueFor().
  bool take();
  void release();

 private:
  std::string name_;
  int file_ = -1;
};

}  // namespace nonet::app
