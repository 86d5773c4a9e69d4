// A few threads that share the work of a step. What each piece of work computes does not depend on which
// thread does it or when.
#pragma once

#include <atomic>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace nonet::sim {

class StepWorkers {
 public:
  /// `threads` counts the caller: with 1 there are no others.
  explicit StepWorkers(int threads);
  ~StepWorkers();
  StepWorkers(const StepWorkers&) = delete;
  StepWorkers& operator=(const StepWorkers&) = delete;

  /// Calls work(0) ... work(count - 1), each once, and returns when all are done. The first exception of a
  /// call is thrown again here.
  void run(std::size_t count, const std::function<void(std::size_t)>& work);

 private:
  void serve();
  void takePieces();

  std::vector<std::thread> threads_;
  std::mutex mutex_;
  std::condition_variable begin_;
  std::condition_variable end_;
  const std::function<void(std::size_t)>* work_ = nullptr;
  std::size_t count_ = 0;
  std::atomic<std::size_t> next_{0};
  std::size_t round_ = 0;
  std::size_t busy_ = 0;
  std::exception_ptr error_;
  bool stop_ = false;
};

/// ODE wants one global initialisation, and data of its own for each thread that uses it.
void prepareOdeThread();

}  // namespace nonet::sim
