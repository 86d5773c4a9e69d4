// Falling and rising on the physics, at reduced counts: `nonet rise-report` measures a hundred falls of each
// kind.
#include <filesystem>

#include <gtest/gtest.h>

#include "nonet/lab/agent_setup.h"
#include "nonet/lab/rise_report.h"

namespace nonet::lab {
namespace {

// As an agent of this type would be set up: with its parameter file.
TrialSetup setupFor(int type) {
  AgentChoice choice;
  choice.robotType = type;
  const agent::AgentConfig config = makeAgentConfig(choice, NONET_SOURCE_DIR);
  TrialSetup setup;
  setup.robotType = type;
  setup.motion = config.parameters.motion;
  setup.world = config.parameters.world;
  setup.skillFolder = config.skillFolder;
  return setup;
}

class Rising : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Types, Rising, testing::Range(0, model::kRobotTypeCount));

TEST_P(Rising, StandsUpFromEverySide) {
  const TrialSetup setup = setupFor(GetParam());
  for (const FallKind kind : {FallKind::Front, FallKind::Back, FallKind::Side}) {
    int fell = 0;
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const Rise rise = fallAndRise(setup, kind, seed);
      if (!rise.fell) continue;
      ++fell;
      EXPECT_TRUE(rise.stands) << "kind " << static_cast<int>(kind) << " seed " << seed;
      EXPECT_LE(rise.attempts, 3);
      EXPECT_LT(rise.time, 10.0);  // the referee takes it away after 15 s on the ground
    }
    EXPECT_GT(fell, 0) << "kind " << static_cast<int>(kind);
  }
}

TEST(RiseReport, TheSameSeedGivesTheSameFall) {
  const TrialSetup setup = setupFor(0);
  const Rise one = fallAndRise(setup, FallKind::Front, 5);
  const Rise two = fallAndRise(setup, FallKind::Front, 5);
  EXPECT_EQ(one.time, two.time);
  EXPECT_EQ(one.attempts, two.attempts);
}

// The protection begins before the torso meets the ground.
TEST(Falling, IsNoticedBeforeImpact) {
  for (const double direction : {1.0, -1.0}) {
    RobotTrial trial(setupFor(0));
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
