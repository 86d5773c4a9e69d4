// How late the machine itself wakes who sleeps: what no program that runs on it can answer faster than.
#pragma once

#include <atomic>
#include <mutex>
#include <thread>
#include <vector>

#include "nonet/math/duration_counts.h"

namespace nonet::app {

/// A thread on every processor that this process may use. It sleeps for kWakeInterval again and again, and
/// looks how much later it wakes. With the right to it (root, or CAP_SYS_NICE), it goes before all ordinary
/// processes: what is late then is the machine, or whoever the machine is lent from.
class WakeWatch {
 public:
  WakeWatch();
  ~WakeWatch();
  WakeWatch(const WakeWatch&) = delete;
  WakeWatch& operator=(const WakeWatch&) = delete;

  /// So far, of all processors.
  DurationCounts delays() const;
  /// All threads go before ordinary processes.
  bool goesFirst() const { return goesFirst_; }

 private:
  void watch(int processor);

  std::atomic<bool> over_{false};
  std::atomic<bool> goesFirst_{true};
  mutable std::mutex mutex_;
  DurationCounts delays_;
  std::vector<std::thread> threads_;
};
inline constexpr double kWakeInterval = 0.002;  // s

}  // namespace nonet::app
