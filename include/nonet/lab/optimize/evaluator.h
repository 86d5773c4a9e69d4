// Many evaluations at once: on threads of this machine or on the ranks of an MPI run. The values do not
// depend on the number of workers or on the order in which they finish.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace nonet::lab {

struct Job {
  Eigen::VectorXd point;
  std::uint64_t seed = 0;
};

/// Pure: the same job gives the same value. Called from several threads at once.
using Objective = std::function<double(const Job&)>;

class Evaluator {
 public:
  virtual ~Evaluator() = default;
  virtual int workers() const = 0;
  /// One value per job, in the order of the jobs.
  virtual std::vector<double> evaluate(std::span<const Job> jobs) = 0;
};

/// `threads` 0: one per core.
std::unique_ptr<Evaluator> makeThreadEvaluator(Objective objective, int threads);

}  // namespace nonet::lab
