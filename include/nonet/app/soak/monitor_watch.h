// Watches a match from outside, over the monitor port, in a thread of its own: who is in play, and whether
// the match goes on.
#pragma once

#include <atomic>
#include <chrono>
#include <map>
#include <mutex>
#include <set>
#include <thread>
#include <utility>

#include "nonet/protocol/monitor_reader.h"

namespace nonet::app {

class MonitorWatch {
 public:
  using Player = std::pair<protocol::TeamSide, int>;  // side, uniform number

  /// Connects as soon as there is a server, and again when it was gone.
  explicit MonitorWatch(int port);
  ~MonitorWatch();
  MonitorWatch(const MonitorWatch&) = delete;
  MonitorWatch& operator=(const MonitorWatch&) = delete;

  bool connected() const { return connected_; }
  /// Players with a number: the server has taken them into a team. Empty without a server.
  std::set<Player> players() const;
  /// How often a player has gone, however soon another robot came in its place.
  int departures(const Player& player) const;
  /// Seconds of the longest silence since the last call, the present one included.
  double longestSilence();

 private:
  using Clock = std::chrono::steady_clock;
  void run();
  void follow(int socket);
  void note(const protocol::MonitorReader& reader);

  int port_;
  std::atomic<bool> over_{false};
  std::atomic<bool> connected_{false};
  mutable std::mutex mutex_;
  std::set<Player> players_;
  std::map<Player, int> departures_;
  Clock::time_point last_ = Clock::now();
  double longest_ = 0.0;
  std::thread thread_;
};

}  // namespace nonet::app
