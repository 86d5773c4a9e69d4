#include "nonet/app/soak/monitor_watch.h"

#include <algorithm>

#include <asio/connect.hpp>
#include <asio/io_context.hpp>
#include <asio/ip/tcp.hpp>
#include <poll.h>

#include "nonet/protocol/framing.h"
#include "nonet/protocol/monitor_reader.h"

namespace nonet::app {

MonitorWatch::MonitorWatch(int port) : port_(port), thread_([this] { run(); }) {}

MonitorWatch::~MonitorWatch() {
  over_ = true;
  thread_.join();
}

std::set<MonitorWatch::Player> MonitorWatch::players() const {
  const std::lock_guard lock(mutex_);
  return players_;
}

double MonitorWatch::longestSilence() {
  const std::lock_guard lock(mutex_);
  const double present = std::chrono::duration<double>(Clock::now() - last_).count();
  return std::max(std::exchange(longest_, 0.0), present);
}

void MonitorWatch::run() {
  asio::io_context io;
  while (!over_) {
    asio::ip::tcp::socket socket(io);
    std::error_code error;
    socket.connect({asio::ip::address_v4::loopback(), static_cast<asio::ip::port_type>(port_)}, error);
    if (!error) {
      connected_ = true;
      follow(socket.native_handle());
      connected_ = false;
      const std::lock_guard lock(mutex_);
      players_.clear();
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}

void MonitorWatch::follow(int socket) {
  protocol::FrameReader frames;
  protocol::MonitorReader reader;
  while (!over_) {
    pollfd descriptor{socket, POLLIN, 0};
    if (::poll(&descriptor, 1, 100) <= 0) continue;
    const std::span<char> room = frames.prepare(65536);
    const ssize_t count = ::recv(socket, room.data(), room.size(), 0);
    if (count <= 0) return;
    frames.received(static_cast<std::size_t>(count));
    while (const auto message = frames.next()) {
      if (reader.feed(*message)) note(reader);
    }
  }
}

void MonitorWatch::note(const protocol::MonitorReader& reader) {
  std::set<Player> players;
  for (const protocol::MonitorRobot& robot : reader.robots()) {
    if (robot.unum > 0) players.emplace(robot.side, robot.unum);
  }
  const std::lock_guard lock(mutex_);
  for (const Player& player : players_) {
    if (!players.contains(player)) ++departures_[player];
  }
  const Clock::time_point now = Clock::now();
  longest_ = std::max(longest_, std::chrono::duration<double>(now - last_).count());
  last_ = now;
  players_ = std::move(players);
}

int MonitorWatch::departures(const Player& player) const {
  const std::lock_guard lock(mutex_);
  const auto found = departures_.find(player);
  return found == departures_.end() ? 0 : found->second;
}

}  // namespace nonet::app
