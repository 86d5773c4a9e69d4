#include "nonet/motion/skill_player.h"

#include <cmath>
#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "nonet/model/kinematics.h"
#include "nonet/motion/skill_language.h"

namespace nonet::motion {
namespace {

using model::index;
using model::JointId;
using Result = SkillPlayer::Result;

class Player : public testing::Test {
 protected:
  void load(const std::string& text, bool mirrored = false,
            const std::optional<KickAim>& aim = std::nullopt) {
    library_ = SkillLibrary(parseSkills(text, "test.skl"));
    player_ = std::make_unique<SkillPlayer>(model_, library_);
    world_.body.cycleTime = kCycleTime;
    targets_ = JointTargets{};
    targets_.stiffness.fill(1.0);
    ASSERT_TRUE(player_->start("a", mirrored, targets_.angles, aim));
  }
  Result step() { return player_->update(world_, targets_); }
  int cyclesToEnd(int most = 1000) {
    int cycles = 1;
    while (step() == Result::Running && cycles < most) ++cycles;
    return cycles;
  }
  double angle(JointId joint) const { return targets_.angles[index(joint)]; }

  const model::RobotModel& model_ = model::robotModel(0);
  SkillLibrary library_;
  std::unique_ptr<SkillPlayer> player_;
  world::WorldState world_;
  JointTargets targets_;
};

TEST_F(Player, MovesWithConstantSpeedAndArrives) {
  load("skill a { move over 0.2s { left.knee -1rad } }");
  for (int i = 1; i <= 10; ++i) {
    EXPECT_EQ(step(), Result::Running);
    EXPECT_NEAR(angle(JointId::LLeg4), -0.1 * i, 1e-12);
  }
  EXPECT_EQ(step(), Result::Finished);
  EXPECT_NEAR(angle(JointId::LLeg4), -1.0, 1e-12);
}

// Full speed from the delay on, to the last part of a cycle.
TEST_F(Player, SwingsAtTheJointsOwnSpeed) {
  load("skill a { swing over 0.2s { left.knee -1rad after 30ms left.hipPitch 0.1rad } }");
  const double most = model_.joint(JointId::LLeg4).maxSpeed;
  for (int i = 1; i <= 10; ++i) {
    EXPECT_EQ(step(), Result::Running);
    const double time = i * kCycleTime;
    EXPECT_NEAR(angle(JointId::LLeg4), -std::min(1.0, most * std::max(0.0, time - 0.03)), 1e-12);
    EXPECT_NEAR(angle(JointId::LLeg3), std::min(0.1, most * time), 1e-12);
  }
  EXPECT_EQ(step(), Result::Finished);
}

TEST_F(Player, KicksSuitThemselvesToBallAimAndPace) {
  const std::string text =
      "skill a { kick { ball (0.2m, 5cm) distance 1m..2m contact 0.1s }"
      "move over 0.2s { left.knee -0.5rad - 1rad * ballAhead left.hipRoll 1rad * ballAside "
      "left.hipPitch 1rad * paceAhead right.hipRoll 1rad * turn + 1rad * paceAside } }";
  for (const bool mirrored : {false, true}) {
    const double left = mirrored ? -1.0 : 1.0;
    load(text, mirrored, KickAim{Vector2(0.23, left * 0.06), left * 0.2, Vector2(0.4, left * 0.1)});
    cyclesToEnd();
    EXPECT_NEAR(angle(mirrored ? JointId::RLeg4 : JointId::LLeg4), -0.53, 1e-12);
    EXPECT_NEAR(angle(mirrored ? JointId::RLeg2 : JointId::LLeg2), left * 0.01, 1e-12);
    EXPECT_NEAR(angle(mirrored ? JointId::RLeg3 : JointId::LLeg3), 0.4, 1e-12);
    EXPECT_NEAR(angle(mirrored ? JointId::LLeg2 : JointId::RLeg2), -left * 0.3, 1e-12);
  }
}

// No farther and no nearer than the head says, and as far as it can when nothing is asked.
TEST_F(Player, KicksSuitThemselvesToTheDistanceAskedFor) {
  const std::string text =
      "skill a { kick { ball (0.2m, 5cm) distance 2m..6m contact 0.1s }"
      "move over 0.2s { left.knee -0.1rad * distance } }";
  const auto kneeFor = [&](const std::optional<KickAim>& aim) {
    load(text, false, aim);
    cyclesToEnd();
    return angle(JointId::LLeg4);
  };
  const auto aimOf = [](double distance) {
    KickAim aim;
    aim.distance = distance;
    return aim;
  };
  EXPECT_NEAR(kneeFor(aimOf(3.5)), -0.35, 1e-12);
  EXPECT_NEAR(kneeFor(aimOf(1.0)), -0.2, 1e-12);
  EXPECT_NEAR(kneeFor(aimOf(9.0)), -0.6, 1e-12);
  EXPECT_NEAR(kneeFor({}), -0.6, 1e-12);
}

// Against the forward kinematics; the right foot does what the left one does, mirrored.
TEST_F(Player, KicksShiftTheFootWithTheBall) {
  const std::string text =
      "skill a { kick { ball (0.2m, 5cm) distance 1m..2m contact 0.1s }"
      "move over 0.4s { left.hipPitch 0.6rad left.knee -1rad shift left foot by "
      "(1m * ballAhead, 0.5m * ballAside, 0.01m) } }";
  for (const bool mirrored : {false, true}) {
    const model::Side side = mirrored ? model::Side::Right : model::Side::Left;
    const double left = mirrored ? -1.0 : 1.0;
    std::array<Vector3, 2> soles;
    for (const bool off : {false, true}) {
      const Vector2 ball = off ? Vector2(0.23, left * 0.02) : Vector2(0.2, left * 0.05);
      load(text, mirrored, KickAim{ball, 0.0, Vector2::Zero()});
      cyclesToEnd();
      model::BodyPoses bodies;
      model::forwardKinematics(model_, targets_.angles, bodies);
      soles[off ? 1 : 0] = model::solePose(model_, bodies, side).translation();
    }
    EXPECT_NEAR((soles[1] - soles[0] - Vector3(0.03, -left * 0.015, 0.0)).norm(), 0.0, 0.003);
  }
}

// To the left for the left foot, by so much more than without; its place is kept.
TEST_F(Player, KicksTurnTheFoot) {
  const auto soleOf = [&](const std::string& turned, bool mirrored) {
    load(
        "skill a { kick { ball (0.2m, 5cm) distance 1m..2m contact 0.1s }"
        "move over 0.4s { left.hipPitch 0.6rad left.knee -1rad shift left foot by (0m, 0m, 0m)" +
            turned + " } }",
        mirrored, KickAim{Vector2(0.2, mirrored ? -0.05 : 0.05), mirrored ? -0.1 : 0.1, Vector2(0.3, 0.0)});
    cyclesToEnd();
    model::BodyPoses bodies;
    model::forwardKinematics(model_, targets_.angles, bodies);
    return model::solePose(model_, bodies, mirrored ? model::Side::Right : model::Side::Left);
  };
  for (const bool mirrored : {false, true}) {
    const Pose3 straight = soleOf("", mirrored);
    const Pose3 turned = soleOf(" turned 1rad * turn - 0.5rad * paceAhead + 0.15rad", mirrored);
    const Eigen::AngleAxisd expected((mirrored ? -1.0 : 1.0) * 0.1, Vector3::UnitZ());
    EXPECT_LT((turned.linear() - expected * straight.linear()).norm(), 0.005);
    EXPECT_LT((turned.translation() - straight.translation()).norm(), 0.003);
  }
}

// What a kick asks of a joint may be too far for its time: it goes as far as it can.
TEST_F(Player, KicksKeepToTheSpeedsOfTheJoints) {
  load(
      "skill a { kick { ball (0.2m, 5cm) distance 1m..2m contact 0.1s } "
      "move over 0.04s { left.knee -1.5rad } move over 0.04s { left.knee 0rad } }");
  const double most = model_.joint(JointId::LLeg4).maxSpeed;
  for (int i = 1; i <= 4; ++i) {
    step();
    EXPECT_NEAR(angle(JointId::LLeg4), -most * kCycleTime * (i <= 2 ? i : 4 - i), 1e-12);
  }
}

TEST_F(Player, PartsOfACycleCarryOver) {
  // Three moves of 30 ms end after 90 ms, not after three times two cycles.
  load(
      "skill a { move over 30ms { left.knee -0.3rad } move over 30ms { left.knee -0.6rad } "
      "move over 30ms { left.knee -0.9rad } }");
  step();
  EXPECT_NEAR(angle(JointId::LLeg4), -0.2, 1e-12);
  step();
  EXPECT_NEAR(angle(JointId::LLeg4), -0.4, 1e-12);
  step();
  EXPECT_NEAR(angle(JointId::LLeg4), -0.6, 1e-12);
  step();
  EXPECT_NEAR(angle(JointId::LLeg4), -0.8, 1e-12);
  EXPECT_EQ(step(), Result::Finished);
  EXPECT_NEAR(angle(JointId::LLeg4), -0.9, 1e-12);
}

TEST_F(Player, SpeedIsThatOfTheLongestWay) {
  load("skill a { move at 2rad/s { left.knee -1rad left.hipPitch 0.5rad } }");
  for (int i = 0; i < 25; ++i) EXPECT_EQ(step(), Result::Running) << i;
  EXPECT_NEAR(angle(JointId::LLeg4), -1.0, 1e-12);
  EXPECT_NEAR(angle(JointId::LLeg3), 0.5, 1e-12);
  EXPECT_EQ(step(), Result::Finished);
}

TEST_F(Player, MirroredExchangesSidesAndSigns) {
  const std::string text =
      "skill a { move over 20ms { left.knee -1rad left.hipRoll 0.3rad head.pan 0.5rad } }";
  load(text, true);
  step();
  EXPECT_NEAR(angle(JointId::RLeg4), -1.0, 1e-12);
  EXPECT_NEAR(angle(JointId::RLeg2), -0.3, 1e-12);
  EXPECT_NEAR(angle(JointId::LLeg4), 0.0, 1e-12);
  EXPECT_NEAR(angle(JointId::Head1), -0.5, 1e-12);
}

TEST_F(Player, MirroredCallInAMirroredSkillIsPlain) {
  load("skill a { call b mirrored } skill b { move over 20ms { left.knee -1rad } }", true);
  step();
  EXPECT_NEAR(angle(JointId::LLeg4), -1.0, 1e-12);
  EXPECT_NEAR(angle(JointId::RLeg4), 0.0, 1e-12);
}

TEST_F(Player, WaitsForAConditionOrTheTime) {
  load("skill a { wait until upright within 0.2s move over 20ms { left.knee -1rad } }");
  world_.body.posture = world::Posture::FallenBack;
  EXPECT_EQ(step(), Result::Running);
  EXPECT_EQ(angle(JointId::LLeg4), 0.0);
  world_.body.posture = world::Posture::Upright;
  EXPECT_EQ(step(), Result::Running);
  EXPECT_NEAR(angle(JointId::LLeg4), -1.0, 1e-12);
  load("skill a { wait until upright within 0.2s }");
  world_.body.posture = world::Posture::FallenBack;
  EXPECT_EQ(cyclesToEnd(), 11);
}

TEST_F(Player, ConditionsSeeTheMirroredWorld) {
  const std::string text = "skill a { if fallen left { end } fail }";
  world_.body.posture = world::Posture::FallenLeft;
  load(text);
  EXPECT_EQ(step(), Result::Finished);
  load(text, true);
  EXPECT_EQ(step(), Result::Failed);
  world_.body.posture = world::Posture::FallenRight;
  load(text, true);
  EXPECT_EQ(step(), Result::Finished);
}

TEST_F(Player, RepeatsAsOftenAsAsked) {
  load("skill a { repeat 3 { repeat 2 { wait 20ms } } }");
  EXPECT_EQ(cyclesToEnd(), 7);
}

TEST_F(Player, EndlessCirclesWithoutTimeFail) {
  // A loop of a thousand rounds of a thousand that takes no time must not stop the robot.
  load("skill a { repeat 1000 { repeat 1000 { stiffness 1 } } }");
  EXPECT_EQ(step(), Result::Failed);
  EXPECT_FALSE(player_->running());
}

TEST_F(Player, FeetGoStraightToTheirPose) {
  load("skill a { move over 0.1s { foot left at (20mm, 60mm, -0.33m) foot right at (0, -55mm, -0.35m) } }");
  for (int i = 0; i < 5; ++i) step();
  model::BodyPoses bodies;
  model::forwardKinematics(model_, targets_.angles, bodies);
  const Pose3 left = model::solePose(model_, bodies, model::Side::Left);
  EXPECT_LT((left.translation() - Vector3(0.02, 0.06, -0.33)).norm(), 1e-9);
  EXPECT_TRUE(left.linear().isIdentity(1e-9));
  const Pose3 right = model::solePose(model_, bodies, model::Side::Right);
  EXPECT_LT((right.translation() - Vector3(0.0, -0.055, -0.35)).norm(), 1e-9);
}

// Slow enough for every joint.
TEST_F(Player, CurvesPassThroughTheirPointsRelativeToTheBall) {
  world_.body.torsoHeight = 0.35;
  load(
      "skill a { curve left foot over 1.2s from ball { point (-0.16m, 0, -5mm) point (-0.1m, 10mm, 20mm) } "
      "}",
      false, KickAim{Vector2(0.15, 0.055), 0.0, Vector2::Zero()});
  model::BodyPoses bodies;
  for (int i = 0; i < 30; ++i) step();
  model::forwardKinematics(model_, targets_.angles, bodies);
  // Ball centre at (0.15, 0.055, 0.042 - 0.35) in the upright torso frame.
  EXPECT_LT((model::solePose(model_, bodies, model::Side::Left).translation() -
             Vector3(-0.01, 0.055, 0.042 - 0.35 - 0.005))
                .norm(),
            1e-9);
  for (int i = 0; i < 30; ++i) step();
  model::forwardKinematics(model_, targets_.angles, bodies);
  EXPECT_LT((model::solePose(model_, bodies, model::Side::Left).translation() -
             Vector3(0.05, 0.065, 0.042 - 0.35 + 0.02))
                .norm(),
            1e-9);
}

// While one foot follows a curve the other one and the arms go straight to their goals; all of it mirrored.
TEST_F(Player, TheOtherFootAndTheArmsMoveBesideACurve) {
  load(
      "skill a { curve left foot over 1.2s { point (20mm, 60mm, -0.32m) point (60mm, 70mm, -0.34m)\n"
      "foot right at (-20mm, -50mm, -0.35m) rpy (0, 0, -10deg) left.shoulderPitch -40deg } }",
      true);
  const auto sole = [&](model::Side side) {
    model::BodyPoses bodies;
    model::forwardKinematics(model_, targets_.angles, bodies);
    return model::solePose(model_, bodies, side);
  };
  const Vector3 from = sole(model::Side::Left).translation();
  for (int i = 0; i < 30; ++i) step();
  const Vector3 half = sole(model::Side::Left).translation();
  EXPECT_LT((half - 0.5 * (from + Vector3(-0.02, 0.05, -0.35))).norm(), 1e-9);
  EXPECT_LT((sole(model::Side::Right).translation() - Vector3(0.02, -0.06, -0.32)).norm(), 1e-9);
  for (int i = 0; i < 30; ++i) step();
  EXPECT_LT((sole(model::Side::Left).translation() - Vector3(-0.02, 0.05, -0.35)).norm(), 1e-9);
  const Matrix3 turned = sole(model::Side::Left).linear();
  EXPECT_NEAR(std::atan2(turned(1, 0), turned(0, 0)), toRadians(10.0), 1e-9);
  EXPECT_LT((sole(model::Side::Right).translation() - Vector3(0.06, -0.07, -0.34)).norm(), 1e-9);
  EXPECT_NEAR(angle(JointId::RArm1), toRadians(-40.0), 1e-12);
  EXPECT_EQ(angle(JointId::LArm1), 0.0);
}

TEST_F(Player, UnknownSkillDoesNotStart) {
  load("skill a { wait 1s }");
  EXPECT_FALSE(player_->start("b", false, targets_.angles));
}

}  // namespace
}  // namespace nonet::motion
