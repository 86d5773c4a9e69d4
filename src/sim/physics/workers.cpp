#include "sim/physics/workers.h"

#include <ode/ode.h>

#include "sim/physics/ode_kernels.h"

namespace nonet::sim {

void prepareOdeThread() {
  static std::once_flag initialised;
  std::call_once(initialised, [] {
    ode_kernels::link();
    dInitODE2(0);
  });
  thread_local const bool prepared = dAllocateODEDataForThread(dAllocateMaskAll) != 0;
  static_cast<void>(prepared);
}

StepWorkers::StepWorkers(int threads, std::chrono::microseconds patience) : patience_(patience) {
  for (int i = 1; i < threads; ++i) threads_.emplace_back([this] { serve(); });
}

StepWorkers::~StepWorkers() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  begin_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

/// Returns once `happened` or after `patience_`. To be woken takes longer than most waits within a cycle.
template <typename Happened>
void StepWorkers::lookOut(const Happened& happened) const {
  if (patience_.count() == 0) return;
  const auto end = std::chrono::steady_clock::now() + patience_;
  while (!happened() && std::chrono::steady_clock::now() < end) std::this_thread::yield();
}

void StepWorkers::run(std::size_t count, const std::function<void(std::size_t)>& work) {
  const bool alone = threads_.empty() || count < 2;
  {
    const std::lock_guard lock(mutex_);
    work_ = &work;
    count_ = count;
    next_ = 0;
    error_ = nullptr;
    if (!alone) {
      busy_ = threads_.size();
      ++round_;
    }
  }
  if (!alone) begin_.notify_all();
  takePieces();
  lookOut([this] { return busy_ == 0; });
  std::unique_lock lock(mutex_);
  end_.wait(lock, [this] { return busy_ == 0; });
  if (error_) std::rethrow_exception(error_);
}

void StepWorkers::takePieces() {
  for (std::size_t i = next_++; i < count_; i = next_++) {
    try {
      (*work_)(i);
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!error_) error_ = std::current_exception();
    }
  }
}

void StepWorkers::serve() {
  prepareOdeThread();
  std::size_t served = 0;
  while (true) {
    lookOut([&] { return stop_ || round_ != served; });
    {
      std::unique_lock lock(mutex_);
      begin_.wait(lock, [&] { return stop_ || round_ != served; });
      if (stop_) return;
      served = round_;
    }
    takePieces();
    {
      const std::lock_guard lock(mutex_);
      --busy_;
    }
    end_.notify_one();
  }
}

}  // namespace nonet::sim
