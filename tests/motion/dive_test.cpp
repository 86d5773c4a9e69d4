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

TEST_P(Goalkeeping, TheBlockSpreadsTheFeetAndStaysUp) {
  RobotTrial trial(agentTrialSetup(GetParam()));
  trial.settle(Pose2());
  const auto width = [&] {
    return trial.physics().bodyPosition(trial.robot(), model::BodyId::LFoot).y() -
           trial.physics().bodyPosition(trial.robot(), model::BodyId::RFoot).y();
  };
  const motion::PlaySkill request{std::string_view("block")};
  float widest = 0.0F;
  for (int i = 0; i < 200 && !trial.motion().state().skillFinished; ++i) {
    trial.step(request);
    widest = std::max(widest, width());
  }
  EXPECT_GT(widest, 0.35F);  // feet of 0.08 m: a bar of 0.43 m
  EXPECT_TRUE(trial.motion().state().skillFinished);
  trial.run(motion::MotionRequest{}, 2.0);
  EXPECT_FALSE(trial.down());
  EXPECT_LT(trial.tilt(), 0.2);
}

}  // namespace
}  // namespace nonet::lab
