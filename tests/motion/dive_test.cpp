// The goalie's skills on the physics: how far they reach, and that the robot rises from them.
#include <gtest/gtest.h>

#include "nonet/lab/trial/dive_trial.h"

#include "motion/trial_setup.h"

namespace nonet::lab {
namespace {

class Goalkeeping : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Types, Goalkeeping, testing::Range(0, model::kRobotTypeCount));

TEST_P(Goalkeeping, DivesReachToBothSidesAndTheRobotRises) {
  const TrialSetup setup = agentTrialSetup(GetParam());
  for (const model::Side side : {model::Side::Left, model::Side::Right}) {
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      const Dive dive = diveAndRise(setup, "dive", side, seed);
      const Dive::Places& low = dive.barred.back()[0];
      EXPECT_TRUE(low[8]) << "0.4 m aside";
      EXPECT_TRUE(low[10]) << "0.5 m aside";
      EXPECT_TRUE(dive.stands);
      EXPECT_LE(dive.attempts, 3);
    }
  }
}

TEST_P(Goalkeeping, TheBlockBarsTheGroundBesideTheRobotAtOnce) {
  const TrialSetup setup = agentTrialSetup(GetParam());
  for (const model::Side side : {model::Side::Left, model::Side::Right}) {
    const Dive block = diveAndRise(setup, "block", side, 1);
    const Dive::Places& low = block.barred[3][0];  // after 0.4 s
    EXPECT_TRUE(low[4]) << "0.2 m aside";
    EXPECT_TRUE(low[5]) << "0.25 m aside";
    EXPECT_TRUE(block.stands);
  }
}

}  // namespace
}  // namespace nonet::lab
