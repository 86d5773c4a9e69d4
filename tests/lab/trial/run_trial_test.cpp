// Runs with the learned values, seeded: on the quick stepper, wide starts, light pushes and noise.
#include "nonet/lab/trial/run_trial.h"

#include <gtest/gtest.h>

#include "nonet/lab/trial/ball_trial.h"

#include "motion/trial_setup.h"

namespace nonet::lab {
namespace {

class Running : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Types, Running, testing::Range(0, model::kRobotTypeCount));

TEST(Runs, OfTheSameSeedAreTheSame) {
  TrialSetup setup = agentTrialSetup(2);
  setup.physics.solver = sim::WorldSettings::Solver::Quick;
  EXPECT_EQ(runAhead(setup, 3).speed, runAhead(setup, 3).speed);
  EXPECT_NE(runAhead(setup, 3).speed, runAhead(setup, 4).speed);
}

}  // namespace
}  // namespace nonet::lab
