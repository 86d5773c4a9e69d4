#include "nonet/motion/walk/run.h"

#include <cmath>

#include <gtest/gtest.h>

#include "nonet/math/angle.h"
#include "nonet/motion/walk/engine.h"

namespace nonet::motion {
namespace {

using model::JointId;
using model::Side;

GaitState running(double phase, Side stance = Side::Left) {
  GaitState gait;
  gait.standing = false;
  gait.phase = phase;
  gait.stance = stance;
  gait.step.translation.x() = 0.1;
  return gait;
}

RunParameters runParameters() {
  RunParameters p;
  p.hipRoll = {.mean = 0.02, .cos1 = 0.05, .sin1 = -0.04, .cos2 = 0.01, .sin2 = 0.03};
  p.knee = {.mean = -0.1, .cos1 = 0.2, .sin1 = 0.1, .cos2 = -0.05, .sin2 = 0.02};
  return p;
}

model::JointArray changed(const GaitState& gait, double share) {
  model::JointArray angles{};
  addRun(runParameters(), gait, share, model::robotModel(0), angles);
  return angles;
}

double angleOf(const model::JointArray& angles, JointId joint) {
  return angles[model::index(joint)];
}

// The two harmonics against the sum written out.
TEST(Run, SwingIsAFourierSumOfTheStride) {
  const JointSwing swing{.mean = 0.1, .cos1 = 0.2, .sin1 = -0.3, .cos2 = 0.05, .sin2 = 0.07};
  EXPECT_NEAR(swing.at(0.0), 0.1 + 0.2 + 0.05, 1e-12);
  EXPECT_NEAR(swing.at(0.25), 0.1 - 0.3 - 0.05, 1e-12);
  EXPECT_NEAR(swing.at(0.125), 0.1 + (0.2 - 0.3) * std::sqrt(0.5) + 0.07, 1e-12);
  EXPECT_NEAR(swing.at(1.3), swing.at(0.3), 1e-12);
}

// What one leg does in its stance the other does in the next step, with rolls mirrored.
TEST(Run, SidesMoveAlikeHalfAStrideApart) {
  for (const double phase : {0.2, 0.6, 1.0}) {
    const auto left = changed(running(phase, Side::Left), 1.0);
    const auto right = changed(running(phase, Side::Right), 1.0);
    EXPECT_NEAR(angleOf(left, JointId::LLeg4), angleOf(right, JointId::RLeg4), 1e-12);
    EXPECT_NEAR(angleOf(left, JointId::RLeg4), angleOf(right, JointId::LLeg4), 1e-12);
    EXPECT_NEAR(angleOf(left, JointId::LLeg2), -angleOf(right, JointId::RLeg2), 1e-12);
    EXPECT_NEAR(angleOf(left, JointId::LLeg4), runParameters().knee.at(0.5 * phase), 1e-12);
  }
}

TEST(Run, ChangesInProportionToItsShare) {
  const auto whole = changed(running(0.4), 1.0);
  const auto third = changed(running(0.4), 1.0 / 3.0);
  for (std::size_t i = 0; i < whole.size(); ++i) EXPECT_NEAR(third[i], whole[i] / 3.0, 1e-12);
  EXPECT_EQ(changed(running(0.4), 0.0), model::JointArray{});
}

TEST(Run, ShareFollowsTheStep) {
  GaitParameters p;
  p.maxStepX = 0.2;
  GaitState gait = running(0.4);
  EXPECT_NEAR(runShare(p, gait), 0.5, 1e-12);
  gait.step.translation.x() = 0.3;
  EXPECT_EQ(runShare(p, gait), 1.0);
  gait.step.translation.x() = -0.1;
  EXPECT_EQ(runShare(p, gait), 0.0);
  gait.step.translation.x() = 0.1;
  gait.standing = true;
  EXPECT_EQ(runShare(p, gait), 0.0);
}

// What the run adds to the toes does not pile up.
TEST(Run, LeavesTheToesWhereTheyAreWhenItIsOver) {
  const model::RobotModel& toed = model::robotModel(4);
  RunParameters p;
  p.toe.mean = -0.006;
  WalkEngine engine(toed, p);
  world::BodyState body;
  body.cycleTime = kCycleTime;
  JointTargets targets;
  for (int i = 0; i < 250; ++i)
    engine.update(body, WalkParameters{}, {.speed = Pose2(0.5, 0.0, 0.0), .walk = true, .run = 1.0}, targets);
  EXPECT_LT(angleOf(targets.angles, JointId::LLeg7), -1e-3);
  EXPECT_GE(angleOf(targets.angles, JointId::LLeg7), p.toe.mean);
  engine.update(body, WalkParameters{}, {.speed = Pose2(0.5, 0.0, 0.0), .walk = true}, targets);
  EXPECT_EQ(angleOf(targets.angles, JointId::LLeg7), 0.0);
  EXPECT_EQ(angleOf(targets.angles, JointId::RLeg7), 0.0);
}

}  // namespace
}  // namespace nonet::motion
