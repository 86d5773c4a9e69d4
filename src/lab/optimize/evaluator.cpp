#include "nonet/lab/optimize/evaluator.h"

#include <algorithm>
#include <thread>

#include "lab/common/parallel.h"

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
    inParallel(static_cast<int>(jobs.size()), threads_, [&](int i) {
      const auto job = static_cast<std::size_t>(i);
      values[job] = objective_(jobs[job]);
    });
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
