// A fixed crew of threads for loops that are run very often (once per simulated cycle).
#pragma once

#include <functional>
#include <memory>

namespace nonet::lab {

class WorkCrew {
 public:
  /// `threads` workers in all, the calling thread included; at least one.
  explicit WorkCrew(int threads);
  ~WorkCrew();
  WorkCrew(const WorkCrew&) = delete;
  WorkCrew& operator=(const WorkCrew&) = delete;

  /// Calls work(i) for i in [0, count), each once, in no particular order, and returns when all are done. The
  /// first exception of a call is thrown again here.
  void run(int count, const std::function<void(int)>& work);

 private:
  struct Shared;
  std::unique_ptr<Shared> shared_;
};

}  // namespace nonet::lab
