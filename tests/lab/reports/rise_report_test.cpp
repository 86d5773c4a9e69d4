// Falling and rising on the physics, at reduced counts: `nonet rise-report` measures a hundred falls of each
// kind.
#include "nonet/lab/reports/rise_report.h"

#include <string_view>

#include <gtest/gtest.h>

#include "nonet/motion/skill_library.h"
#include "nonet/motion/skill_player.h"
#include "nonet/motion/walk/engine.h"

#include "lab/trial_setup.h"

namespace nonet::lab {
namespace {

class Rising : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Types, Rising, testing::Range(0, model::kRobotTypeCount));

TEST_P(Rising, StandsUpFromEverySide) {
  const TrialSettings setup = agentTrialSettings(GetParam());
  for (const FallKind kind : {FallKind::Front, FallKind::Back, FallKind::Side}) {
    int fell = 0;
    // Throws that the robot survives on its feet do not count.
    for (std::uint64_t seed = 1; seed <= 60 && fell < 3; ++seed) {
      const Rise rise = fallAndRise(setup, kind, seed);
      if (!rise.fell) continue;
      ++fell;
      EXPECT_TRUE(rise.stands) << "kind " << static_cast<int>(kind) << " seed " << seed;
      EXPECT_LE(rise.attempts, 3);
      EXPECT_LT(rise.time, 10.0);  // the referee takes it away after 15 s on the ground
    }
    EXPECT_EQ(fell, 3) << "kind " << static_cast<int>(kind);
  }
}

// For limbs that collide the referee freezes their joints for a second.
TEST_P(Rising, FromTheFrontHardlyCollidesWithItself) {
  TrialSettings setup = agentTrialSettings(GetParam());
  setup.physics.solver = sim::WorldSettings::Solver::Quick;
  int fell = 0, collided = 0;
  for (std::uint64_t seed = 1; seed <= 60 && fell < 20; ++seed) {
    const Rise rise = fallAndRise(setup, FallKind::Front, seed);
    fell += rise.fell ? 1 : 0;
    collided += rise.fell && rise.collided > 0.0 ? 1 : 0;
  }
  EXPECT_EQ(fell, 20);
  EXPECT_LE(collided, 3);
}

// The second and third attempts, each by itself from lying still.
TEST(RiseSkills, EveryVariantGetsUp) {
  const TrialSettings setup = agentTrialSettings(0);
  const motion::SkillLibrary library(setup.skillFolder, setup.motion.skills);
  const model::JointArray stand =
      motion::WalkEngine::standAngles(model::robotModel(0), setup.motion.sets.goToTarget);
  for (const char* name :
       {"rise_front", "rise_front_2", "rise_front_3", "rise_back", "rise_back_2", "rise_back_3"}) {
    RobotTrial trial(setup);
    trial.settle(Pose2());
    motion::JointTargets targets;
    targets.angles = trial.belief().body.joints;
    targets.stiffness.fill(1.0);
    const double lean = std::string_view(name).starts_with("rise_front") ? 0.7 : -0.7;
    for (const auto ankle : {model::JointId::LLeg5, model::JointId::RLeg5})
      targets.angles[model::index(ankle)] += lean;
    for (int i = 0; i < 100; ++i) trial.stepJoints(targets);
    ASSERT_TRUE(world::isFallen(trial.belief().body.posture)) << name;
    motion::SkillPlayer player(trial.model(), library, stand);
    ASSERT_TRUE(player.start(name, false, targets.angles));
    for (int i = 0; i < 400 && player.running(); ++i) {
      player.update(trial.belief(), targets);
      trial.stepJoints(targets);
    }
    for (int i = 0; i < 25; ++i) trial.stepJoints(targets);
    EXPECT_FALSE(trial.down()) << name;
    EXPECT_LT(trial.tilt(), 0.3) << name;
  }
}

TEST(RiseReport, TheSameSeedGivesTheSameFall) {
  const TrialSettings setup = agentTrialSettings(0);
  const Rise one = fallAndRise(setup, FallKind::Front, 5);
  const Rise two = fallAndRise(setup, FallKind::Front, 5);
  EXPECT_EQ(one.time, two.time);
  EXPECT_EQ(one.attempts, two.attempts);
}

// The protection begins before the torso meets the ground.
TEST(Falling, IsNoticedBeforeImpact) {
  for (const double direction : {1.0, -1.0}) {
    RobotTrial trial(agentTrialSettings(0));
    trial.settle(Pose2());
    motion::JointTargets lean;
    lean.angles = trial.belief().body.joints;
    lean.stiffness.fill(1.0);
    lean.angles[model::index(model::JointId::LLeg5)] += 0.7 * direction;
    lean.angles[model::index(model::JointId::RLeg5)] += 0.7 * direction;
    for (int i = 0; i < 50 && trial.tilt() < 0.4; ++i) trial.stepJoints(lean);
    double height = trial.torsoPosition().z();
    int cycles = 0;
    while (!trial.motion().fall().active() && cycles < 100) {
      trial.step(motion::MotionRequest{});
      height = trial.torsoPosition().z();
      ++cycles;
    }
    EXPECT_LT(cycles, 100);
    EXPECT_GT(height, 0.15) << "direction " << direction;  // the torso lies at 0.06 m
  }
}

}  // namespace
}  // namespace nonet::lab
