// Curves of a foot: their time against the joints' speed limits cycle by cycle, their anchor at a ball that
// moves, and the check before a kick against the general inverse kinematics and a posture whose balance is
// known.
#include "nonet/motion/foot_curve.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "nonet/model/inverse_kinematics.h"
#include "nonet/model/kinematics.h"
#include "nonet/motion/curve_check.h"
#include "nonet/motion/kick_control.h"
#include "nonet/motion/skill_language.h"
#include "nonet/motion/skill_player.h"

namespace nonet::motion {
namespace {

using model::Side;

const model::RobotModel& robot() {
  return model::robotModel(0);
}

Pose3 soleOf(const model::JointArray& angles, Side side) {
  model::BodyPoses bodies = model::identityPoses();
  model::forwardKinematics(robot(), angles, bodies);
  return model::solePose(robot(), bodies, side);
}

class Curves : public testing::Test {
 protected:
  void load(const std::string& text) {
    library_ = SkillLibrary(parseSkills(text, "test.skl"));
    player_ = std::make_unique<SkillPlayer>(robot(), library_);
    world_.body.cycleTime = kCycleTime;
    world_.body.torsoHeight = 0.33;
    targets_ = JointTargets{};
    targets_.stiffness.fill(1.0);
    // Knees bent: near the straight leg a small way is much turning.
    for (const Side side : {Side::Left, Side::Right})
      model::setLegAngles(side, {0.0, 0.0, 0.6, -1.2, 0.6, 0.0}, targets_.angles);
    ASSERT_TRUE(player_->start("a", false, targets_.angles));
  }

  SkillLibrary library_;
  std::unique_ptr<SkillPlayer> player_;
  world::WorldState world_;
  JointTargets targets_;
};

const std::string kWay =
    "{ point (-0.05m, 60mm, -0.30m) point (0.1m, 60mm, -0.31m) point (0.05m, 60mm, -0.32m) } }";

TEST_F(Curves, TakeLongerWhereAJointWouldBeTooFast) {
  load("skill a { curve left foot over 0.1s " + kWay);
  double fastest = 0.0;
  int cycles = 0;
  for (bool runs = true; runs; ++cycles) {
    const model::JointArray before = targets_.angles;
    runs = player_->update(world_, targets_) == SkillPlayer::Result::Running;
    for (const model::JointSpec& joint : robot().joints()) {
      const std::size_t i = model::index(joint.id);
      fastest = std::max(fastest, std::abs(targets_.angles[i] - before[i]) / (joint.maxSpeed * kCycleTime));
    }
  }
  EXPECT_LE(fastest, 1.0);
  EXPECT_GT(fastest, 0.9);  // and it takes no longer than it must
  ASSERT_TRUE(player_->stretch());
  EXPECT_DOUBLE_EQ(player_->stretch()->wanted, 0.1);
  EXPECT_NEAR(player_->stretch()->taken, cycles * kCycleTime, 2 * kCycleTime);
  EXPECT_LT((soleOf(targets_.angles, Side::Left).translation() - Vector3(0.05, 0.06, -0.32)).norm(), 1e-9);
}

TEST_F(Curves, TakeTheTimeThatTheyAreGivenWhereTheJointsCan) {
  load("skill a { curve left foot over 1s " + kWay);
  int cycles = 1;
  while (player_->update(world_, targets_) == SkillPlayer::Result::Running) ++cycles;
  EXPECT_EQ(cycles, 51);
  EXPECT_FALSE(player_->stretch());
}

TEST_F(Curves, GoWithTheBallUntilItIsKicked) {
  const std::string text =
      "skill a { curve left foot over 0.6s from ball { point (-0.15m, 0, 0.02m) point (-0.1m, 0, 0.02m) } }";
  const auto endWith = [&](const Vector2& moved, double speed) {
    load(text);
    world_.ball.known = true;
    world_.ball.p_RB = {0.15, 0.055};
    world_.ball.v_FB = Vector3::Zero();
    for (int i = 0; i < 10; ++i) player_->update(world_, targets_);
    world_.ball.p_RB += moved;
    world_.ball.v_FB.x() = speed;
    while (player_->update(world_, targets_) == SkillPlayer::Result::Running) continue;
    return Vector2(soleOf(targets_.angles, Side::Left).translation().head<2>());
  };
  const Vector2 still = endWith(Vector2::Zero(), 0.0);
  EXPECT_LT((still - Vector2(0.05, 0.055)).norm(), 1e-6);
  EXPECT_LT((endWith({0.02, -0.01}, 0.1) - still - Vector2(0.02, -0.01)).norm(), 1e-6);
  EXPECT_LT((endWith({0.02, 0.0}, 3.0) - still).norm(), 1e-6);
  EXPECT_LT((endWith({0.5, 0.0}, 0.0) - still).norm(), 1e-6);  // no foot follows so far
}

// With the weight over the right foot, or between both.
std::string kickAlong(const std::string& name, const char* weight) {
  return "skill " + name +
         " { kick { ball (0.17m, 5cm) within (9cm, 9cm) distance 1m..3m contact 0.3s from stand }\n" +
         (std::string(weight) == "right"
              ? "move over 0.3s { foot left at (0, 0.11m, -0.30m) foot right at (0, 0, -0.32m) }"
              : "move over 0.3s { foot left at (0, 55mm, -0.30m) foot right at (0, -55mm, -0.32m) }") +
         "curve left foot over 0.3s from ball { point (-0.2m, 20mm, 0) point (-0.12m, 10mm, 0) point "
         "(-0.08m, 0, 10mm) } }\n";
}

class Check : public testing::Test {
 protected:
  static model::JointArray stand() {
    model::JointArray angles{};
    for (const Side side : {Side::Left, Side::Right})
      model::setLegAngles(side, {0.0, 0.0, 0.6, -1.2, 0.6, 0.0}, angles);
    return angles;
  }
  SkillLibrary library_{parseSkills(
      kickAlong("kick_a", "right") + kickAlong("kick_b", "both") +
          "skill kick_c { kick { ball (0.17m, 5cm) distance 1m..3m contact 0.3s from stand } wait 0.1s }",
      "test.skl")};
  KickCatalogue catalogue_{library_, 0};
  CurveCheck check_{robot(), library_, stand()};
};

// The ball goes from under the robot to where no leg reaches.
TEST_F(Check, AllowsWhatTheLegReachesByTheGeneralInverseKinematics) {
  const KickOption& kick = catalogue_.options()[0];
  int allowed = 0;
  for (double ahead = 0.1; ahead < 0.4; ahead += 0.02) {
    // The stance foot does not move, so in the end the ball lies as far ahead of it as in the stand.
    const double before = soleOf(stand(), Side::Right).translation().x();
    const Vector3 origin(ahead - before, 0.05 + 0.055, -0.32 + 0.0403);
    FootCurve curve;
    Pose3 left = Pose3::Identity();
    left.translation() = Vector3(0.0, 0.11, -0.30);
    curve.plan(library_.skill(0).program[1], false, left, origin);
    int exact = 0;
    for (int i = 1; i <= CurveCheck::kSamples; ++i) {
      model::LegAngles leg{};
      const Pose3 X_RS = curve.at(static_cast<double>(i) / CurveCheck::kSamples);
      exact += model::legInverseKinematics(robot(), Side::Left, X_RS, leg) == model::Reach::Exact ? 1 : 0;
    }
    const bool reaches = exact > CurveCheck::kReached * CurveCheck::kSamples;
    const CurveCheck::Result result = check_.check(kick, Vector2(ahead, 0.05));
    EXPECT_EQ(result.reached > CurveCheck::kReached, reaches) << ahead;
    allowed += result.allows() ? 1 : 0;
  }
  EXPECT_GT(allowed, 2);
  EXPECT_LT(allowed, 14);
}

TEST_F(Check, WantsTheWeightOverTheStanceFoot) {
  EXPECT_TRUE(check_.check(catalogue_.options()[0], {0.17, 0.05}).balanced);
  EXPECT_FALSE(check_.check(catalogue_.options()[2], {0.17, 0.05}).balanced);
}

TEST_F(Check, IsTheSameForBothFeet) {
  for (const double ahead : {0.1, 0.17, 0.25, 0.35}) {
    const CurveCheck::Result left = check_.check(catalogue_.options()[0], {ahead, 0.05});
    const CurveCheck::Result right = check_.check(catalogue_.options()[1], {ahead, -0.05});
    EXPECT_EQ(left.reached, right.reached);
    EXPECT_EQ(left.balanced, right.balanced);
  }
}

TEST_F(Check, HoldsUpNoKickWithoutACurve) {
  EXPECT_TRUE(check_.check(catalogue_.options()[4], {2.0, 0.05}).allows());
}

// kick_b is as near but would fall, kick_c has no curve.
TEST_F(Check, TheNextCheapestKickBeginsInPlaceOfOneThatCannot) {
  KickControl control(catalogue_, KickParameters{}, &check_);
  const WalkEngine walk(robot());
  KickTo request;
  request.ball = {0.17, 0.05};
  request.target = {3.0, 0.05};
  EXPECT_EQ(control.update(request, walk, 1.0).option->name, "kick_a");
  EXPECT_TRUE(control.update(request, walk, 1.0).begin);
  control.reset();
  request.kick = std::string_view("kick_b");
  EXPECT_FALSE(control.update(request, walk, 1.0).begin);
}

}  // namespace
}  // namespace nonet::motion
