// Evaluations on the ranks of an MPI job, one rank per core. Rank 0 hands out one job at a time to whoever is
// free and evaluates too; the others serve. A rank that dies keeps the one job it held: as soon as that is
// overdue it is given to another rank as well, and since an evaluation is a pure function it does not matter
// who answers first. So nothing is lost, and no rank is waited for longer than that, as long as rank 0 lives.
//
// The launcher must not end the whole job when one rank dies: `mpirun --enable-recovery` (Open MPI 4),
// `srun --kill-on-bad-exit=0 --no-kill`.
#pragma once

#include <memory>
#include <string>

#include "nonet/lab/optimize/evaluator.h"

namespace nonet::lab {

/// Membership in an MPI job: MPI_Init when made, MPI_Finalize at the end. At most one per process.
class MpiJob {
 public:
  /// Throws std::runtime_error if the program was built without MPI.
  MpiJob();
  ~MpiJob();
  MpiJob(const MpiJob&) = delete;
  MpiJob& operator=(const MpiJob&) = delete;

  int rank() const { return rank_; }
  int size() const { return size_; }
  /// Rank 0's text, on every rank. Collective.
  std::string share(const std::string& text) const;

  /// A rank that does not answer would block MPI_Finalize: end without it.
  void giveUpFinalize() { finalize_ = false; }

 private:
  int rank_ = 0;
  int size_ = 1;
  bool finalize_ = true;
};

/// On rank 0. The other ranks are told to stop when the evaluator is destroyed.
std::unique_ptr<Evaluator> makeMpiEvaluator(MpiJob& job, Objective objective);

/// On the other ranks: evaluates until rank 0 says stop, or is silent for so long that it must be dead.
void serveEvaluations(MpiJob& job, const Objective& objective);

}  // namespace nonet::lab
