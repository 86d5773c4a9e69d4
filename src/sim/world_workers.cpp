#include "sim/world_workers.h"

#include <ode/ode.h>

#include "sim/ode_kernels.h"

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

StepWorkers::StepWorkers(int threads) {
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
