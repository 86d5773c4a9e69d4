// A one-shot timer whose action never runs after it was cancelled or set anew.
//
// Asio promises less: a timer that has expired puts its handler into the queue, and a cancel() that comes
// while it waits there is too late; the handler then runs as if nothing had happened. Under load this is the
// ordinary case: the process sleeps, and on waking up finds both the message that should stop the timer and
// the timer itself.
#pragma once

#include <chrono>
#include <functional>
#include <memory>

#include <asio/io_context.hpp>
#include <asio/steady_timer.hpp>

namespace nonet::app {

class Alarm {
 public:
  explicit Alarm(asio::io_context& io) : timer_(io) {}
  ~Alarm() { cancel(); }
  Alarm(const Alarm&) = delete;
  Alarm& operator=(const Alarm&) = delete;

  /// Runs `action` once after `seconds`, unless set() or cancel() is called or the alarm is destroyed before.
  void set(double seconds, std::function<void()> action);
  void cancel();

 private:
  asio::steady_timer timer_;
  std::shared_ptr<long> generation_ = std::make_shared<long>(0);  // a queued handler outlives the alarm
};

}  // namespace nonet::app
