// Accepting anew after a failure, such as no file descriptor left: at once it would fail again, for ever, and
// nothing else would be done.
#pragma once

#include <chrono>
#include <functional>
#include <utility>

#include <asio/io_context.hpp>
#include <asio/steady_timer.hpp>

namespace nonet::sim {

class AcceptPause {
 public:
  explicit AcceptPause(asio::io_context& io) : timer_(io) {}

  void start(std::function<void()> again) {
    timer_.expires_after(std::chrono::milliseconds(500));
    timer_.async_wait([again = std::move(again)](std::error_code error) {
      if (!error) again();
    });
  }
  void cancel() { timer_.cancel(); }

 private:
  asio::steady_timer timer_;
};

}  // namespace nonet::sim
