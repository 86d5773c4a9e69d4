// Threads and MPI ranks against plain evaluation in a loop.
#include <array>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <thread>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "nonet/lab/optimize/evaluator_mpi.h"

namespace nonet::lab {
namespace {

double plain(const Job& job) {
  return std::sin(job.point.sum()) + static_cast<double>(job.seed % 1000) / 7.0;
}

std::vector<Job> makeJobs(int count) {
  std::vector<Job> jobs;
  for (int i = 0; i < count; ++i)
    jobs.push_back({Eigen::VectorXd::LinSpaced(5, i, 0.3 * i + 1.0), 0x123456789ULL * (i + 1)});
  return jobs;
}

void expectPlainValues(Evaluator& evaluator, int count) {
  const std::vector<Job> jobs = makeJobs(count);
  const std::vector<double> values = evaluator.evaluate(jobs);
  ASSERT_EQ(values.size(), jobs.size());
  for (std::size_t i = 0; i < jobs.size(); ++i) EXPECT_EQ(values[i], plain(jobs[i])) << i;
}

TEST(ThreadEvaluator, GivesTheSameValuesInOrderOnAnyNumberOfThreads) {
  for (const int threads : {1, 2, 5}) {
    const auto evaluator = makeThreadEvaluator(plain, threads);
    EXPECT_EQ(evaluator->workers(), threads);
    for (const int count : {0, 1, 3, 50}) expectPlainValues(*evaluator, count);
  }
}

TEST(ThreadEvaluator, PassesAnErrorOn) {
  const auto evaluator = makeThreadEvaluator(
      [](const Job& job) {
        if (job.seed == 0x123456789ULL * 7) throw std::runtime_error("seventh");
        return 0.0;
      },
      3);
  EXPECT_THROW(evaluator->evaluate(makeJobs(20)), std::runtime_error);
}

// Runs one of the disabled tests below on three ranks; the exit status of mpirun. Open MPI's plugins never
// give back what they took and are unloaded, so that nothing names them: a sanitized rank looks for no leaks,
// or each would end with 1.
int underMpirun(const std::string& test, const std::string& options) {
  std::array<char, 4096> self{};
  if (readlink("/proc/self/exe", self.data(), self.size() - 1) < 0) return -1;
  const std::string command = fmt::format(
      "ASAN_OPTIONS=$ASAN_OPTIONS:detect_leaks=0 mpirun -n 3 --allow-run-as-root --oversubscribe {} {} "
      "--gtest_also_run_disabled_tests "
      "--gtest_filter=OnRanks.DISABLED_{} 2>&1",
      options, self.data(), test);
  return std::system(command.c_str());  // NOLINT(concurrency-mt-unsafe)
}

bool haveMpirun() {
  return std::system("mpirun --version > /dev/null 2>&1") == 0;  // NOLINT(concurrency-mt-unsafe)
}

TEST(MpiEvaluator, GivesTheSameValuesOnThreeRanks) {
  if (!haveMpirun()) GTEST_SKIP() << "there is no mpirun on this machine";
  EXPECT_EQ(underMpirun("Evaluate", ""), 0);
}

TEST(MpiEvaluator, DropsARankThatDiesAndRepeatsItsEvaluation) {
  if (!haveMpirun()) GTEST_SKIP() << "there is no mpirun on this machine";
  EXPECT_EQ(underMpirun("LoseOne", "--enable-recovery"), 0);
}

TEST(MpiEvaluator, PassesAnErrorOfAnotherRankOn) {
  if (!haveMpirun()) GTEST_SKIP() << "there is no mpirun on this machine";
  EXPECT_EQ(underMpirun("Fail", ""), 0);
}

double slowly(const Job& job) {
  std::this_thread::sleep_for(std::chrono::milliseconds(2));
  return plain(job);
}

TEST(OnRanks, DISABLED_Evaluate) {
  MpiJob job;
  ASSERT_EQ(job.size(), 3);
  EXPECT_EQ(job.share(job.rank() == 0 ? "of rank 0" : ""), "of rank 0");
  if (job.rank() != 0) return serveEvaluations(job, slowly);
  const auto evaluator = makeMpiEvaluator(job, slowly);
  EXPECT_EQ(evaluator->workers(), 3);
  for (const int count : {0, 1, 3, 100}) expectPlainValues(*evaluator, count);
}

TEST(OnRanks, DISABLED_LoseOne) {
  MpiJob job;
  if (job.rank() != 0) {
    return serveEvaluations(job, [&job, done = 0](const Job& work) mutable {
      if (job.rank() == 2 && ++done == 5) raise(SIGKILL);
      return slowly(work);
    });
  }
  const auto evaluator = makeMpiEvaluator(job, slowly);
  for (int batch = 0; batch < 3; ++batch) expectPlainValues(*evaluator, 60);
  EXPECT_EQ(evaluator->workers(), 2);
}

TEST(OnRanks, DISABLED_Fail) {
  MpiJob job;
  const auto failing = [&job](const Job& work) {
    if (job.rank() == 1) throw std::runtime_error("as it should");
    return slowly(work);
  };
  if (job.rank() != 0) return serveEvaluations(job, failing);
  const auto evaluator = makeMpiEvaluator(job, failing);
  EXPECT_THROW(evaluator->evaluate(makeJobs(30)), std::runtime_error);
}

}  // namespace
}  // namespace nonet::lab
