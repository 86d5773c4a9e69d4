// A few threads that share the work of a step. What each piece of work computes does not depend on which
// thread does it or when.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace nonet::sim {

class StepWorkers {
 public:
  /// `threads` counts the caller: with 1 there are no others. One that has nothing to do looks out for work
  /// for `patience` before it sleeps; whatever else wants its core meanwhile gets it.
  explicit StepWorkers(int threads, std::chrono::microseconds patience = std::chrono::microseconds(0));
  ~StepWorkers();
  StepWorkers(const StepWorkers&) = delete;
  StepWorkers& operator=(const StepWorkers&) = delete;

  /// Calls work(0) ... work(count - 1), each once, and returns when all are done. The first exception of a
  /// call is thrown again here.
  void run(std::size_t count, const std::function<void(std::size_t)>& work);

 private:
  void serve();
  void takePieces();
  template <typename Happened>
  void lookOut(const Happened& happened) const;

  std::chrono::microseconds patience_;
  std::vector<std::thread> threads_;
  std::mutex mutex_;
  std::condition_variable begin_;
  std::condition_variable end_;
  const std::function<void(std::size_t)>* work_ = nullptr;
  std::size_t count_ = 0;
  std::atomic<std::size_t> next_{0};
  std::atomic<std::size_t> round_{0};
  std::atomic<std::size_t> busy_{0};
  std::exception_ptr error_;
  std::atomic<bool> stop_{false};
};

/// ODE wants one global initialisation, and data of its own for each thread that uses it.
void prepareOdeThread();

}  // namespace nonet::sim
