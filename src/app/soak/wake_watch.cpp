#include "nonet/app/soak/wake_watch.h"

#include <chrono>

#include <pthread.h>
#include <sched.h>

namespace nonet::app {

namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

void stayOn(int processor) {
  cpu_set_t set;
  CPU_ZERO(&set);
  CPU_SET(processor, &set);
  ::pthread_setaffinity_np(::pthread_self(), sizeof set, &set);
}

bool goFirst() {
  sched_param parameters{};
  parameters.sched_priority = ::sched_get_priority_max(SCHED_FIFO);
  return ::pthread_setschedparam(::pthread_self(), SCHED_FIFO, &parameters) == 0;
}

}  // namespace

WakeWatch::WakeWatch() {
  cpu_set_t mine;
  CPU_ZERO(&mine);
  if (::sched_getaffinity(0, sizeof mine, &mine) != 0) return;
  for (int processor = 0; processor < CPU_SETSIZE; ++processor) {
    if (CPU_ISSET(processor, &mine)) threads_.emplace_back([this, processor] { watch(processor); });
  }
}

WakeWatch::~WakeWatch() {
  over_ = true;
  for (std::thread& thread : threads_) thread.join();
}

DurationCounts WakeWatch::delays() const {
  const std::lock_guard lock(mutex_);
  return delays_;
}

void WakeWatch::watch(int processor) {
  stayOn(processor);
  if (!goFirst()) goesFirst_ = false;
  while (!over_) {
    const Clock::time_point due = Clock::now() + std::chrono::round<Clock::duration>(Seconds(kWakeInterval));
    std::this_thread::sleep_until(due);
    const double delay = Seconds(Clock::now() - due).count();
    const std::lock_guard lock(mutex_);
    delays_.add(delay);
  }
}

}  // namespace nonet::app
