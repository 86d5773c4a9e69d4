#include "sim/server/connection.h"

#include <algorithm>
#include <stdexcept>

#include <asio/buffer.hpp>
#include <asio/error.hpp>
#include <fmt/format.h>
#include <spdlog/spdlog.h>

namespace nonet::sim {

namespace {

std::string nameOf(const asio::ip::tcp::socket& socket) {
  std::error_code error;
  const auto endpoint = socket.remote_endpoint(error);
  return error ? "unknown" : fmt::format("{}:{}", endpoint.address().to_string(), endpoint.port());
}

}  // namespace

asio::ip::tcp::acceptor listenOn(asio::io_context& io, const std::string& address, std::uint16_t port,
                                 const char* purpose) {
  try {
    return asio::ip::tcp::acceptor(
        io, asio::ip::tcp::endpoint(asio::ip::make_address(address), port));  // with address reuse
  } catch (const std::system_error& error) {
    if (error.code() == asio::error::address_in_use) {
      throw std::runtime_error(fmt::format(
          "port {} (for {}) is taken: is another server running? Choose another port", port, purpose));
    }
    throw std::runtime_error(
        fmt::format("cannot listen on {} port {} (for {}): {}; the address must be one of this machine, in "
                    "numbers, such as 0.0.0.0",
                    address, port, purpose, error.code().message()));
  }
}

Connection::Connection(asio::ip::tcp::socket socket) : socket_(std::move(socket)), peer_(nameOf(socket_)) {
  std::error_code ignored;
  socket_.set_option(asio::ip::tcp::no_delay(true), ignored);
  socket_.non_blocking(true, ignored);
}

void Connection::start(std::function<void(std::string_view)> onMessage, std::function<bool()> paused) {
  onMessage_ = std::move(onMessage);
  paused_ = std::move(paused);
  read();
}

void Connection::resume() {
  if (dead_ || delivering_) return;
  share_ = kReadShare;
  deliver();
  read();
}

void Connection::read() {
  if (dead_ || reading_ || share_ == 0 || paused_()) return;
  reading_ = true;
  constexpr std::size_t kChunk = 4096;
  const std::span<char> room = frames_.prepare(kChunk);
  socket_.async_read_some(asio::buffer(room.data(), room.size()),
                          [self = shared_from_this()](std::error_code error, std::size_t size) {
                            self->reading_ = false;
                            if (self->dead_) return;
                            if (error) {
                              const bool closed = error == asio::error::eof;
                              return self->die(closed ? "closed by the other side" : error.message());
                            }
                            self->share_ -= std::min(self->share_, size);
                            self->frames_.received(size);
                            self->deliver();
                            self->read();
                          });
}

void Connection::deliver() {
  delivering_ = true;
  while (!dead_ && !paused_()) {
    const auto message = frames_.next();
    if (!message) break;
    onMessage_(*message);
  }
  delivering_ = false;
  if (!dead_ && frames_.failed()) {
    refused_ = true;
    die(frames_.error());
  }
}

bool Connection::send(std::string_view message) {
  if (dead_) return false;
  flush();
  if (dead_ || !rest_.empty()) return false;
  out_.clear();
  protocol::appendFrame(out_, message);
  std::error_code error;
  const std::size_t sent = socket_.write_some(asio::buffer(out_), error);
  if (error && error != asio::error::would_block && error != asio::error::try_again) {
    die(error.message());
    return false;
  }
  if (sent < out_.size()) {
    rest_.assign(out_, sent, std::string::npos);
    waitToFlush();
  }
  return true;
}

void Connection::flush() {
  if (rest_.empty()) return;
  std::error_code error;
  const std::size_t sent = socket_.write_some(asio::buffer(rest_), error);
  if (error && error != asio::error::would_block && error != asio::error::try_again)
    return die(error.message());
  rest_.erase(0, sent);
}

void Connection::waitToFlush() {
  if (dead_ || waitingToFlush_ || rest_.empty()) return;
  waitingToFlush_ = true;
  socket_.async_wait(asio::ip::tcp::socket::wait_write, [self = shared_from_this()](std::error_code error) {
    self->waitingToFlush_ = false;
    if (error || self->dead_) return;
    self->flush();
    self->waitToFlush();
  });
}

void Connection::die(const std::string& reason) {
  if (dead_) return;
  dead_ = true;
  reason_ = reason;
  std::error_code ignored;
  socket_.close(ignored);
}

void Connection::close() {
  die("closed by the server");
}

void Admission::tell(const Connection& newcomer, const char* kind) const {
  spdlog::warn("server: {} {} is refused, and more of them: {} connections are the most, {} from one address",
               kind, newcomer.peer(), most_, mostPerAddress_);
}

}  // namespace nonet::sim
