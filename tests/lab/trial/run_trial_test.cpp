// Runs with the learned values, seeded: on the quick stepper, wide starts, light pushes and noise.
#include "nonet/lab/trial/run_trial.h"

#include <functional>

#include <gtest/gtest.h>

#include "nonet/lab/trial/ball_trial.h"

#include "lab/trial_setup.h"

namespace nonet::lab {
namespace {

class Running : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Types, Running, testing::Range(0, model::kRobotTypeCount));

TEST(Runs, OfTheSameSeedAreTheSame) {
  TrialSettings setup = agentTrialSettings(2);
  setup.physics.solver = sim::WorldSettings::Solver::Quick;
  EXPECT_EQ(runAhead(setup, 3).speed, runAhead(setup, 3).speed);
  EXPECT_NE(runAhead(setup, 3).speed, runAhead(setup, 4).speed);
}

struct Tally {
  int falls = 0;
  double speed = 0.0;  // m/s, means
  double fast = 0.0;
};

// Of twenty such runs of this type.
Tally tallyOf(int type, const std::function<RunOutcome(const TrialSettings&, std::uint64_t)>& run) {
  TrialSettings setup = agentTrialSettings(type);
  setup.physics.solver = sim::WorldSettings::Solver::Quick;
  constexpr int kRuns = 20;
  Tally tally;
  for (std::uint64_t seed = 1; seed <= kRuns; ++seed) {
    const RunOutcome outcome = run(setup, seed);
    tally.falls += outcome.fell || outcome.fellAfter ? 1 : 0;
    tally.speed += outcome.speed / kRuns;
    tally.fast += outcome.fast / kRuns;
  }
  return tally;
}

// Out of stands and walks, among pushes, and then a stop or another walk: hardly ever with a fall.
TEST_P(Running, OutOfAnyWalkAndBackWithoutAFall) {
  const Tally tally = tallyOf(GetParam(), runAhead);
  EXPECT_LE(tally.falls, 1);
  EXPECT_GT(tally.fast, 1.35);  // m/s
}

// After a target that leaps aside: who turns, slows down and gathers speed again hardly ever falls.
TEST_P(Running, AfterATargetThatLeapsAside) {
  const Tally tally = tallyOf(
      GetParam(), [](const TrialSettings& setup, std::uint64_t seed) { return runAfter(setup, seed); });
  EXPECT_LE(tally.falls, 3);
  EXPECT_GT(tally.speed, 1.0);  // m/s
}

TEST(Runs, AfterATargetAreHarderTheMoreItLeaps) {
  TrialSettings setup = agentTrialSettings(2);
  setup.physics.solver = sim::WorldSettings::Solver::Quick;
  double still = 0.0, leaping = 0.0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    still += runAfter(setup, seed, 0.0).speed;
    leaping += runAfter(setup, seed, 1.0).speed;
  }
  EXPECT_GT(still, 1.1 * leaping);
  EXPECT_EQ(runAfter(setup, 3).speed, runAfter(setup, 3).speed);
}

// With its own eyes along the field, as `nonet ball-report --skill run` measures it.
TEST_P(Running, AlongTheFieldAndStops) {
  sim::Settings server;
  server.quickSolver = true;
  int falls = 0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const lab::Run run = runOnce(agentOfType(GetParam()), server, seed);
    EXPECT_GT(run.speed, 1.45);    // m/s
    EXPECT_LT(run.stopTime, 1.8);  // s
    falls += run.fell ? 1 : 0;
  }
  EXPECT_EQ(falls, 0);
}

}  // namespace
}  // namespace nonet::lab
