#include "nonet/lab/optimize/evaluator.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>

namespace nonet::lab {

namespace {

class ThreadEvaluator final : public Evaluator {
 public:
  ThreadEvaluator(Objective objective, int threads)
      : objective_(std::move(objective)),
        threads_(threads > 0 ? threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()))) {
  }

  int workers() const override { return threads_; }

  std::vector<double> evaluate(std::span<const Job> jobs) override {
    std::vector<double> values(jobs.size());
    std::atomic<std::size_t> next{0};
    std::exception_ptr failure;
    std::mutex failureMutex;
    const auto work = [&] {
      for (std::size_t i = next++; i < jobs.size(); i = next++) {
        try {
          values[i] = objective_(jobs[i]);
        } catch (...) {
          const std::scoped_lock lock(failureMutex);
          if (!failure) failure = std::current_exception();
          next = jobs.size();
        }
      }
    };
    {
      std::vector<std::jthread> pool;
      const std::size_t helpers = std::min<std::size_t>(static_cast<std::size_t>(threads_), jobs.size());
      for (std::size_t i = 1; i < helpers; ++i) pool.emplace_back(work);
      work();
    }
    if (failure) std::rethrow_exception(failure);
    return values;
  }

 private:
  Objective objective_;
  int threads_;
};

}  // namespace

std::unique_ptr<Evaluator> makeThreadEvaluator(Objective objective, int threads) {
  return std::make_unique<ThreadEvaluator>(std::move(objective), threads);
}

}  // namespace nonet::lab
