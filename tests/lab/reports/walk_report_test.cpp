// Walking on the physics, at reduced counts: `nonet walk-report` and the course of `nonet optimize` measure
// the same at length.
#include "nonet/lab/reports/walk_report.h"

#include <gtest/gtest.h>

#include "nonet/lab/trial/robot_trial.h"
#include "nonet/math/random.h"

#include "lab/trial_setup.h"

namespace nonet::lab {
namespace {

using motion::MotionRequest;

TrialSettings setupFor(int type) {
  TrialSettings setup;
  setup.robotType = type;
  setup.skillFolder = NONET_SOURCE_DIR "/skills";
  setup.motion.skills = motion::declareSkillParameters(setup.skillFolder);
  return setup;
}

MotionRequest velocity(double x, double y, double turn) {
  return motion::WalkVelocity{Pose2(x, y, turn)};
}

class EveryType : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Types, EveryType, testing::Range(0, model::kRobotTypeCount));

TEST_P(EveryType, StandsStill) {
  RobotTrial trial(setupFor(GetParam()));
  trial.settle(Pose2());
  const Pose2 start = trial.pose();
  trial.run(MotionRequest{}, 5.0);
  EXPECT_LT((trial.pose().translation - start.translation).norm(), 1e-3);
  EXPECT_LT(trial.tilt(), 0.01);
  EXPECT_NEAR(trial.torsoPosition().z(), 0.88 * trial.model().standingHeight(), 0.01);
}

// With the learned sets: gains that steady the walk must not set a stand swinging.
TEST_P(EveryType, ComesToRestInItsStand) {
  RobotTrial trial(agentTrialSettings(GetParam()));
  trial.settle(Pose2());
  trial.run(velocity(0.3, 0.1, 0.0), 1.0);
  trial.run(MotionRequest{}, 10.0);
  double fastest = 0.0;
  for (int i = 0; i < 100; ++i) {
    trial.step(MotionRequest{});
    fastest = std::max(fastest, trial.belief().body.gyro.norm());
  }
  EXPECT_LT(fastest, 0.2);  // rad/s
}

TEST_P(EveryType, WalksForwardSidewaysAndTurns) {
  {
    RobotTrial trial(setupFor(GetParam()));
    trial.settle(Pose2());
    trial.run(velocity(9.0, 0.0, 0.0), 10.0);
    EXPECT_GT(trial.pose().translation.norm(), 10.0 * 0.40);
    EXPECT_FALSE(trial.down());
  }
  {
    RobotTrial trial(setupFor(GetParam()));
    trial.settle(Pose2());
    trial.run(velocity(0.0, 9.0, 0.0), 4.0);
    EXPECT_GT(trial.pose().translation.y(), 4.0 * 0.25);
    EXPECT_FALSE(trial.down());
  }
  {
    RobotTrial trial(setupFor(GetParam()));
    trial.settle(Pose2());
    double turned = 0.0;
    double last = trial.pose().rotation;
    for (int i = 0; i < 150; ++i) {
      trial.step(velocity(0.0, 0.0, -9.0));
      turned += wrapAngle(trial.pose().rotation - last);
      last = trial.pose().rotation;
    }
    EXPECT_LT(turned, -3.0 * toRadians(60.0));
    EXPECT_FALSE(trial.down());
  }
}

TEST_P(EveryType, StaysUpThroughQuickChanges) {
  TrialSettings setup = setupFor(GetParam());
  RobotTrial trial(setup);
  trial.settle(Pose2());
  Random random(21);
  for (int i = 0; i < 20; ++i) {
    const bool stop = random.below(4) == 0;
    const MotionRequest wish =
        stop ? MotionRequest{}
             : velocity(random.uniform(-9, 9), random.uniform(-9, 9), random.uniform(-4, 4));
    trial.run(wish, random.uniform(0.2, 1.5));
    ASSERT_FALSE(trial.down()) << "change " << i;
  }
  trial.run(MotionRequest{}, 2.0);
  EXPECT_TRUE(trial.motion().walk().standing());
  EXPECT_LT(trial.tilt(), 0.03);
}

TEST(WalkTrial, TheSameSeedGivesTheSameBits) {
  const auto signature = [] {
    RobotTrial trial(setupFor(0));
    trial.settle(Pose2(0.3, -0.2, 0.7));
    trial.run(velocity(1.0, 0.2, 0.3), 2.0);
    return trial.physics().signature();
  };
  EXPECT_EQ(signature(), signature());
}

TEST(WalkReport, DoesNotDependOnTheNumberOfThreads) {
  WalkReportSettings settings;
  settings.setup = setupFor(0);
  settings.trials = 1;
  settings.threads = 1;
  const std::string one = walkReportJson(measureWalk(settings));
  settings.threads = 3;
  EXPECT_EQ(walkReportJson(measureWalk(settings)), one);
}

}  // namespace
}  // namespace nonet::lab
