#include "nonet/app/alarm.h"

#include <utility>

namespace nonet::app {

void Alarm::set(double seconds, std::function<void()> action) {
  using Clock = asio::steady_timer::clock_type;
  const long mine = ++*generation_;
  timer_.expires_after(std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds)));
  timer_.async_wait([mine, generation = generation_, action = std::move(action)](std::error_code error) {
    if (!error && *generation == mine) action();
  });
}

void Alarm::cancel() {
  ++*generation_;
  timer_.cancel();
}

}  // namespace nonet::app
