// A loop over independent jobs on several threads. Which thread does which job is left open, so a job may
// depend on its number only.
#pragma once

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "nonet/lab/common/progress.h"

namespace nonet::lab {

/// Calls job(0) ... job(count - 1) on no more threads than jobs. `threads` 0: as many as there are
/// processors. After an exception no job begins any more; the first one is thrown again here. Threads that
/// the system does not give are done without.
template <class Job>
void inParallel(int count, int threads, const Job& job) {
  const int most = threads > 0 ? threads : static_cast<int>(std::thread::hardware_concurrency());
  const int workers = std::clamp(most, 1, std::max(1, count));
  std::atomic<int> next{0};
  std::exception_ptr failure;
  std::mutex failureMutex;
  const auto work = [&] {
    try {
      for (int i = next++; i < count; i = next++) job(i);
    } catch (...) {
      const std::lock_guard lock(failureMutex);
      if (!failure) failure = std::current_exception();
      next = count;
    }
  };
  std::vector<std::thread> others;
  try {
    for (int i = 1; i < workers; ++i) others.emplace_back(work);
  } catch (const std::system_error&) {
    // Fewer of them do the same work.
  }
  work();
  for (std::thread& other : others) other.join();
  if (failure) std::rethrow_exception(failure);
}

/// The same, and tells of each job that is done.
template <class Job>
void inParallel(int count, int threads, const TrialProgress& progress, const std::string& what,
                const Job& job) {
  std::mutex mutex;
  int done = 0;
  inParallel(count, threads, [&](int i) {
    job(i);
    if (!progress) return;
    const std::lock_guard lock(mutex);
    progress(what, ++done, count);
  });
}

}  // namespace nonet::lab
