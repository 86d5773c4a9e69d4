#include "nonet/lab/optimize/evaluator_mpi.h"

#include <stdexcept>

#ifndef NONET_MPI

namespace nonet::lab {

namespace {
[[noreturn]] void noMpi() {
  throw std::runtime_error("this program was built without MPI; install Open MPI and build again");
}
}  // namespace

MpiJob::MpiJob() {
  noMpi();
}
MpiJob::~MpiJob() = default;
std::string MpiJob::share(const std::string& text) const {
  return text;
}
std::unique_ptr<Evaluator> makeMpiEvaluator(MpiJob&, Objective) {
  noMpi();
}
void serveEvaluations(MpiJob&, const Objective&) {
  noMpi();
}

}  // namespace nonet::lab

#else

#include <chrono>
#include <condition_variable>
#include <cstring>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include <mpi.h>

namespace nonet::lab {

namespace {

using Clock = std::chrono::steady_clock;

enum Tag : int { kTagJob = 1, kTagStop, kTagAlive, kTagResult };

// Blocking MPI calls spin; a rank that has nothing to do should leave its core alone.
constexpr auto kPoll = std::chrono::microseconds(200);
constexpr auto kAliveEvery = std::chrono::seconds(5);
constexpr auto kRankZeroSilent = std::chrono::seconds(180);
// A job is overdue after so many times the longest evaluation so far.
constexpr double kOverdue = 2.0;

struct JobHeader {
  std::int64_t id;
  std::uint64_t seed;
};

struct Result {
  std::int64_t id = 0;
  double value = 0.0;
  std::string error;  // of the exception that ended the evaluation
};

std::string packJob(std::int64_t id, const Job& job) {
  const JobHeader header{id, job.seed};
  const std::size_t bytes = sizeof(double) * static_cast<std::size_t>(job.point.size());
  std::string packed(sizeof header + bytes, '\0');
  std::memcpy(packed.data(), &header, sizeof header);
  if (bytes > 0) std::memcpy(packed.data() + sizeof header, job.point.data(), bytes);
  return packed;
}

Job unpackJob(const std::string& packed, std::int64_t& id) {
  JobHeader header{};
  std::memcpy(&header, packed.data(), sizeof header);
  id = header.id;
  Job job;
  job.seed = header.seed;
  const std::size_t bytes = packed.size() - sizeof header;
  job.point.resize(static_cast<Eigen::Index>(bytes / sizeof(double)));
  if (bytes > 0) std::memcpy(job.point.data(), packed.data() + sizeof header, bytes);
  return job;
}

std::string packResult(const Result& result) {
  std::string packed(reinterpret_cast<const char*>(&result.id), sizeof result.id);
  packed.append(reinterpret_cast<const char*>(&result.value), sizeof result.value);
  return packed.append(result.error);
}

Result unpackResult(const std::string& packed) {
  Result result;
  std::memcpy(&result.id, packed.data(), sizeof result.id);
  std::memcpy(&result.value, packed.data() + sizeof result.id, sizeof result.value);
  result.error = packed.substr(sizeof result.id + sizeof result.value);
  return result;
}

Result evaluateJob(const Objective& objective, std::int64_t id, const Job& job) {
  Result result{.id = id, .value = 0.0, .error = {}};
  try {
    result.value = objective(job);
  } catch (const std::exception& error) {
    result.error = error.what();
    if (result.error.empty()) result.error = "unknown error";
  }
  return result;
}

struct Message {
  int source = 0;
  int tag = 0;
  std::string bytes;
};

std::optional<Message> receive() {
  int there = 0;
  MPI_Status status;
  if (MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &there, &status) != MPI_SUCCESS || there == 0)
    return std::nullopt;
  int size = 0;
  MPI_Get_count(&status, MPI_BYTE, &size);
  Message message{.source = status.MPI_SOURCE,
                  .tag = status.MPI_TAG,
                  .bytes = std::string(static_cast<std::size_t>(size), '\0')};
  MPI_Recv(message.bytes.data(), size, MPI_BYTE, message.source, message.tag, MPI_COMM_WORLD, &status);
  return message;
}

// Rank 0's own evaluations, beside the thread that talks to MPI.
class LocalWorker {
 public:
  explicit LocalWorker(const Objective& objective)
      : thread_([this, &objective](const std::stop_token& stop) { work(stop, objective); }) {}

  void start(std::int64_t id, const Job& job) {
    {
      const std::scoped_lock lock(mutex_);
      job_ = job;
      id_ = id;
    }
    changed_.notify_one();
  }
  std::optional<Result> take() {
    const std::scoped_lock lock(mutex_);
    return std::exchange(result_, std::nullopt);
  }

 private:
  void work(const std::stop_token& stop, const Objective& objective) {
    std::unique_lock lock(mutex_);
    while (changed_.wait(lock, stop, [this] { return job_.has_value(); })) {
      const Job job = *job_;
      const std::int64_t id = id_;
      job_.reset();
      lock.unlock();
      Result result = evaluateJob(objective, id, job);
      lock.lock();
      result_ = std::move(result);
    }
  }

  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::optional<Job> job_;
  std::int64_t id_ = 0;
  std::optional<Result> result_;
  std::jthread thread_;  // last: it uses the others
};

class MpiEvaluator final : public Evaluator {
 public:
  MpiEvaluator(MpiJob& job, Objective objective)
      : job_(job),
        objective_(std::move(objective)),
        local_(objective_),
        ranks_(static_cast<std::size_t>(job.size())) {}

  ~MpiEvaluator() override {
    awaitSecondCopies();
    // Finalizing waits for all ranks: where one is lost, nobody may.
    const bool complete = workers() == job_.size();
    if (!complete) job_.giveUpFinalize();
    for (int rank = 1; rank < job_.size(); ++rank) send(rank, kTagStop, complete ? "" : "one is lost");
  }
  MpiEvaluator(const MpiEvaluator&) = delete;
  MpiEvaluator& operator=(const MpiEvaluator&) = delete;

  int workers() const override {
    int count = 0;
    for (const Rank& rank : ranks_) count += rank.overdue ? 0 : 1;
    return count;
  }

  std::vector<double> evaluate(std::span<const Job> jobs) override {
    jobs_ = jobs;
    firstId_ = nextId_;
    nextId_ += static_cast<std::int64_t>(jobs.size());
    values_.assign(jobs.size(), 0.0);
    done_.assign(jobs.size(), 0);
    left_ = jobs.size();
    nextJob_ = 0;
    while (left_ > 0) {
      const bool moved = collect() || handOut();
      remindOthers();
      if (!moved) std::this_thread::sleep_for(kPoll);
    }
    return values_;
  }

 private:
  struct Rank {
    bool busy = false;
    bool overdue = false;  // its job was given to another rank as well, or another has answered it
    std::int64_t id = 0;   // of the job it holds
    Clock::time_point since{};
    Clock::time_point heard{};
  };
  struct Sent {
    MPI_Request request;
    std::string bytes;
  };

  void send(int rank, Tag tag, std::string bytes) {
    // Never waits: a message to a dead rank stays here for ever.
    sent_.push_back(std::make_unique<Sent>(Sent{MPI_REQUEST_NULL, std::move(bytes)}));
    Sent& sent = *sent_.back();
    MPI_Isend(sent.bytes.data(), static_cast<int>(sent.bytes.size()), MPI_BYTE, rank, tag, MPI_COMM_WORLD,
              &sent.request);
    std::erase_if(sent_, [](const std::unique_ptr<Sent>& other) {
      int finished = 0;
      return MPI_Test(&other->request, &finished, MPI_STATUS_IGNORE) == MPI_SUCCESS && finished != 0;
    });
  }

  bool collect() {
    bool any = false;
    if (const auto result = local_.take()) {
      accept(0, *result);
      any = true;
    }
    while (const auto message = receive()) {
      if (message->tag == kTagResult) accept(message->source, unpackResult(message->bytes));
      any = true;
    }
    return any;
  }

  void accept(int source, const Result& result) {
    Rank& rank = ranks_[static_cast<std::size_t>(source)];
    longest_ = std::max(longest_, Clock::now() - rank.since);
    rank.busy = rank.overdue = false;
    if (!result.error.empty())
      throw std::runtime_error("rank " + std::to_string(source) + ": " + result.error);
    const std::int64_t index = result.id - firstId_;
    // Late answers, of an earlier batch or to what another rank has answered, are the same numbers.
    if (index < 0 || done_[static_cast<std::size_t>(index)] != 0) return;
    values_[static_cast<std::size_t>(index)] = result.value;
    done_[static_cast<std::size_t>(index)] = 1;
    --left_;
  }

  bool handOut() {
    bool any = false;
    for (std::size_t r = 0; r < ranks_.size(); ++r) {
      if (ranks_[r].busy) continue;
      const auto index = nextJob_ < jobs_.size() ? std::optional(nextJob_++) : overdueJob();
      if (!index) break;
      give(r, *index);
      any = true;
    }
    return any;
  }

  void give(std::size_t r, std::size_t index) {
    Rank& rank = ranks_[r];
    rank.busy = true;
    rank.id = firstId_ + static_cast<std::int64_t>(index);
    rank.since = rank.heard = Clock::now();
    if (r == 0) {
      local_.start(rank.id, jobs_[index]);
    } else {
      send(static_cast<int>(r), kTagJob, packJob(rank.id, jobs_[index]));
    }
  }

  std::optional<std::size_t> overdueJob() {
    if (longest_ == Clock::duration::zero()) return std::nullopt;
    for (Rank& rank : ranks_) {
      if (!rank.busy || rank.overdue || !isLate(rank)) continue;
      rank.overdue = true;
      if (!isAnswered(rank)) return static_cast<std::size_t>(rank.id - firstId_);
    }
    return std::nullopt;
  }

  bool isLate(const Rank& rank) const {
    return Clock::now() - rank.since >=
           std::chrono::duration_cast<Clock::duration>(longest_ * kOverdue) + 10 * kPoll;
  }

  /// Whether another rank has answered the job of this one, be it in an earlier batch.
  bool isAnswered(const Rank& rank) const {
    const std::int64_t index = rank.id - firstId_;
    return index < 0 || done_[static_cast<std::size_t>(index)] != 0;
  }

  // At the end: who holds a job that another has answered does so too before long, or is lost.
  void awaitSecondCopies() {
    ranks_[0].overdue = false;  // it knows that it lives
    while (!secondCopiesSettled()) std::this_thread::sleep_for(kPoll);
  }

  bool secondCopiesSettled() {
    while (const auto message = receive()) {
      Rank& rank = ranks_[static_cast<std::size_t>(message->source)];
      if (message->tag == kTagResult) rank.busy = rank.overdue = false;
    }
    bool settled = true;
    for (std::size_t r = 1; r < ranks_.size(); ++r) {
      Rank& rank = ranks_[r];
      if (!rank.busy || rank.overdue || !isAnswered(rank)) continue;
      rank.overdue = isLate(rank);
      settled = settled && rank.overdue;
    }
    return settled;
  }

  // Idle ranks must know that rank 0 lives.
  void remindOthers() {
    const auto now = Clock::now();
    for (std::size_t r = 1; r < ranks_.size(); ++r) {
      if (ranks_[r].busy || now - ranks_[r].heard < kAliveEvery) continue;
      send(static_cast<int>(r), kTagAlive, {});
      ranks_[r].heard = now;
    }
  }

  MpiJob& job_;
  Objective objective_;
  LocalWorker local_;
  std::vector<Rank> ranks_;
  std::vector<std::unique_ptr<Sent> > sent_;
  std::int64_t nextId_ = 0;
  Clock::duration longest_ = Clock::duration::zero();
  // The batch under way.
  std::span<const Job> jobs_;
  std::int64_t firstId_ = 0;
  std::vector<double> values_;
  std::vector<char> done_;
  std::size_t left_ = 0;
  std::size_t nextJob_ = 0;
};

}  // namespace

MpiJob::MpiJob() {
  int provided = 0;
  if (MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided) != MPI_SUCCESS)
    throw std::runtime_error("MPI does not start; run the program by mpirun or srun");
  MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &size_);
}

MpiJob::~MpiJob() {
  if (finalize_) MPI_Finalize();
}

std::string MpiJob::share(const std::string& text) const {
  auto size = static_cast<std::uint64_t>(text.size());
  MPI_Bcast(&size, 1, MPI_UINT64_T, 0, MPI_COMM_WORLD);
  std::string shared = text;
  shared.resize(size);
  MPI_Bcast(shared.data(), static_cast<int>(size), MPI_BYTE, 0, MPI_COMM_WORLD);
  return shared;
}

std::unique_ptr<Evaluator> makeMpiEvaluator(MpiJob& job, Objective objective) {
  return std::make_unique<MpiEvaluator>(job, std::move(objective));
}

void serveEvaluations(MpiJob& job, const Objective& objective) {
  if (job.rank() == 0) throw std::runtime_error("rank 0 hands out the work");
  auto heard = Clock::now();
  while (Clock::now() - heard < kRankZeroSilent) {
    const auto message = receive();
    if (!message) {
      std::this_thread::sleep_for(kPoll);
      continue;
    }
    if (message->tag == kTagStop) {
      if (!message->bytes.empty()) job.giveUpFinalize();
      return;
    }
    if (message->tag == kTagJob) {
      std::int64_t id = 0;
      const Job work = unpackJob(message->bytes, id);
      const std::string answer = packResult(evaluateJob(objective, id, work));
      MPI_Send(answer.data(), static_cast<int>(answer.size()), MPI_BYTE, 0, kTagResult, MPI_COMM_WORLD);
    }
    heard = Clock::now();
  }
  job.giveUpFinalize();  // rank 0 is lost
}

}  // namespace nonet::lab

#endif
