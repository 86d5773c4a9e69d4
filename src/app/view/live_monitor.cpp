#include "nonet/app/view/live_monitor.h"

#include <asio.hpp>
#include <fmt/format.h>

namespace nonet::app {
namespace {

using asio::ip::tcp;

constexpr std::chrono::seconds kPause(1);         // between two attempts to connect
constexpr std::size_t kReadSize = 1U << 16U;      // bytes
constexpr std::size_t kMaxFrames = 25 * 60 * 60;  // an hour of the stream: a quarter of a gigabyte

}  // namespace

LiveMonitor::LiveMonitor(asio::io_context& io, std::string host, std::string port, Track& track)
    : host_(std::move(host)), port_(std::move(port)), track_(track), resolver_(io), socket_(io), timer_(io) {
  say(fmt::format("waiting for a server at {}:{}", host_, port_));
  connect();
}

void LiveMonitor::connect() {
  resolver_.async_resolve(host_, port_, [this](std::error_code error, const auto& endpoints) {
    if (error) return retry();
    asio::async_connect(socket_, endpoints, [this](std::error_code failure, const tcp::endpoint&) {
      if (failure) return retry();
      frames_.reset();
      say(fmt::format("live from {}:{}", host_, port_));
      read();
    });
  });
}

void LiveMonitor::retry() {
  std::error_code ignored;
  socket_.close(ignored);
  say(fmt::format("waiting for a server at {}:{}", host_, port_));
  timer_.expires_after(kPause);
  timer_.async_wait([this](std::error_code error) {
    if (!error) connect();
  });
}

void LiveMonitor::read() {
  const auto room = frames_.prepare(kReadSize);
  socket_.async_read_some(asio::buffer(room.data(), room.size()),
                          [this](std::error_code error, std::size_t size) {
                            if (error) return retry();
                            frames_.received(size);
                            take();
                            if (frames_.failed()) return retry();
                            read();
                          });
}

void LiveMonitor::take() {
  while (const auto message = frames_.next()) {
    if (!reader_.feed(*message)) continue;
    if (track_.frames() < kMaxFrames) {
      track_.add(reader_);
    } else {
      say("an hour is recorded, no more is kept: start nonet view again");
    }
  }
}

void LiveMonitor::say(std::string state) {
  if (state == state_) return;
  state_ = std::move(state);
  fmt::print("view: {}\n", state_);
  std::fflush(stdout);
}

}  // namespace nonet::app
