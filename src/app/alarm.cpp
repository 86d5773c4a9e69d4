#include "nonet/app/alarm.h"

#include <algorithm>
#include <utility>

namespace nonet::app {
namespace {

constexpr double kLongest = 1e9;  // s, 30 years: ten times as much does not fit into the clock's nanoseconds

}  // namespace

void Alarm::set(double seconds, std::function<void()> action) {
  using Clock = asio::steady_timer::clock_type;
  const long mine = ++*generation_;
  const std::chrono::duration<double> time(std::min(seconds, kLongest));
  timer_.expires_after(std::chrono::duration_cast<Clock::duration>(time));
  timer_.async_wait([mine, generation = generation_, action = std::move(action)](std::error_code error) {
    if (!error && *generation == mine) action();
  });
}

void Alarm::cancel() {
  ++*generation_;
  timer_.cancel();
}

}  // namespace nonet::app
