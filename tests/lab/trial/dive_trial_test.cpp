// The goalie's skills on the physics: how far they reach, and that the robot rises from them.
#include "nonet/lab/trial/dive_trial.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "lab/trial_setup.h"

namespace nonet::lab {
namespace {

class Goalkeeping : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Types, Goalkeeping, testing::Range(0, model::kRobotTypeCount));

TEST_P(Goalkeeping, DivesReachToBothSidesAndTheRobotRises) {
  const TrialSettings setup = agentTrialSettings(GetParam());
  for (const model::Side side : {model::Side::Left, model::Side::Right}) {
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      const Dive dive = diveAndRise(setup, "dive", side, seed);
      // After a second, of the places along the ground from 0.15 to 0.55 m aside.
      const Dive::Places& low = dive.barred.back()[0];
      EXPECT_GE(std::count(low.begin() + 3, low.begin() + 12, true), 7);
      EXPECT_TRUE(dive.stands);
      EXPECT_LE(dive.attempts, 3);
    }
  }
}

TEST_P(Goalkeeping, TheBlockBarsTheGroundBesideTheRobot) {
  const TrialSettings setup = agentTrialSettings(GetParam());
  for (const model::Side side : {model::Side::Left, model::Side::Right}) {
    const Dive block = diveAndRise(setup, "block", side, 1);
    // After a second, of the places along the ground up to 0.25 m aside.
    const Dive::Places& low = block.barred.back()[0];
    EXPECT_GE(std::count(low.begin(), low.begin() + 6, true), 5);
    EXPECT_TRUE(block.stands);
  }
}

}  // namespace
}  // namespace nonet::lab
