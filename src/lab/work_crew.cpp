#include "nonet/lab/work_crew.h"

#include <algorithm>
#include <atomic>
#include <barrier>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace nonet::lab {

struct WorkCrew::Shared {
  explicit Shared(int threads) : start(threads), done(threads) {}

  void takePart() {
    for (int i = next.fetch_add(1); i < count; i = next.fetch_add(1)) {
      try {
        (*work)(i);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!error) error = std::current_exception();
      }
    }
  }

  std::barrier<> start;
  std::barrier<> done;
  std::atomic<int> next{0};
  int count = 0;
  const std::function<void(int)>* work = nullptr;
  bool stopping = false;
  std::mutex mutex;
  std::exception_ptr error;
  std::vector<std::thread> others;
};

WorkCrew::WorkCrew(int threads) : shared_(std::make_unique<Shared>(std::max(threads, 1))) {
  Shared& shared = *shared_;
  for (int i = 1; i < threads; ++i) {
    shared.others.emplace_back([&shared] {
      for (;;) {
        shared.start.arrive_and_wait();
        if (shared.stopping) return;
        shared.takePart();
        shared.done.arrive_and_wait();
      }
    });
  }
}

WorkCrew::~WorkCrew() {
  shared_->stopping = true;
  shared_->start.arrive_and_wait();
  for (std::thread& other : shared_->others) other.join();
}

void WorkCrew::run(int count, const std::function<void(int)>& work) {
  Shared& shared = *shared_;
  shared.next = 0;
  shared.count = count;
  shared.work = &work;
  shared.error = nullptr;
  shared.start.arrive_and_wait();
  shared.takePart();
  shared.done.arrive_and_wait();
  if (shared.error) std::rethrow_exception(shared.error);
}

}  // namespace nonet::lab
