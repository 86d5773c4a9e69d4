// Falling and rising without physics: the test says how the robot lies.
#include "nonet/motion/fall_control.h"

#include <gtest/gtest.h>

#include "nonet/agent/agent_setup.h"
#include "nonet/motion/motion.h"
#include "nonet/motion/skill_library.h"
#include "nonet/motion/skill_player.h"
#include "nonet/motion/walk/engine.h"

namespace nonet::motion {
namespace {

/// A robot that fell, as motion sees it.
struct Fallen {
  explicit Fallen(const agent::AgentSettings& agent)
      : model(model::robotModel(0)),
        library(agent.skillFolder, agent.parameters.motion.skills),
        stand(WalkEngine::standAngles(model, agent.parameters.motion.sets.positioning)),
        fall(model, library, agent.parameters.motion.fall, stand),
        player(model, library, stand) {}

  model::JointArray lie(world::Posture posture, double time) {
    state.time = time;
    state.body.posture = posture;
    JointTargets targets;
    EXPECT_TRUE(fall.update(state, player, targets));
    return targets.angles;
  }

  const model::RobotModel& model;
  SkillLibrary library;
  model::JointArray stand;
  FallControl fall;
  SkillPlayer player;
  world::WorldState state;
};

TEST(FallControl, BeginsAnewWhenTheRobotComesToLieOnAnotherSide) {
  const agent::AgentSettings agent = agent::makeAgentSettings({}, NONET_SOURCE_DIR);
  for (const double turnsAt : {0.1, 0.3, 1.0}) {
    Fallen turned(agent);  // falls on its back and rolls to the right
    Fallen onBack(agent);  // stays on its back
    Fallen onSide(agent);  // begins when the first one has rolled
    for (int cycle = 0; cycle < 90; ++cycle) {
      const double time = 10.0 + cycle * kCycleTime;
      const bool rolled = cycle * kCycleTime >= turnsAt - 1e-9;
      const auto angles = turned.lie(rolled ? world::Posture::FallenRight : world::Posture::FallenBack, time);
      const auto back = onBack.lie(world::Posture::FallenBack, time);
      if (rolled && turnsAt < agent.parameters.motion.fall.reconsiderTime) {
        EXPECT_EQ(angles, onSide.lie(world::Posture::FallenRight, time)) << turnsAt << " s, cycle " << cycle;
      } else {
        EXPECT_EQ(angles, back) << turnsAt << " s, cycle " << cycle;
      }
    }
    EXPECT_EQ(turned.fall.attempts(), 1) << "it is still the first attempt";
  }
}

// It rises, stands for a second, in part of which a skill is played and nobody asks, and falls again.
TEST(FallControl, AFallAfterASkillIsANewOne) {
  const agent::AgentSettings agent = agent::makeAgentSettings({}, NONET_SOURCE_DIR);
  Fallen robot(agent);
  robot.state.body.cycleTime = kCycleTime;
  for (int cycle = 0; cycle < 40; ++cycle) robot.lie(world::Posture::FallenBack, 10.0 + cycle * kCycleTime);
  ASSERT_EQ(robot.fall.attempts(), 1);
  JointTargets targets;
  robot.state.body.posture = world::Posture::Upright;
  robot.state.body.torsoHeight = robot.model.standingHeight();
  double time = 10.8;
  for (bool rises = true; rises; time += kCycleTime) {
    robot.state.time = time;
    rises = robot.fall.update(robot.state, robot.player, targets);
    ASSERT_LT(time, 20.0);
  }
  EXPECT_EQ(robot.fall.attempts(), 1);
  for (int cycle = 0; cycle < 40; ++cycle)
    robot.lie(world::Posture::FallenBack, time + 1.0 + cycle * kCycleTime);
  EXPECT_EQ(robot.fall.attempts(), 1);
}

// A goal falls while a robot rises, and it is beamed to its place: it stands there.
TEST(FallControl, ABeamEndsIt) {
  const agent::AgentSettings agent = agent::makeAgentSettings({}, NONET_SOURCE_DIR);
  Motion motion(model::robotModel(0), agent.parameters.motion, agent.skillFolder);
  world::WorldState state;
  const auto update = [&] {
    state.time += kCycleTime;
    return motion.update(state, Stand{}, {}, {});
  };
  state.time = 10.0;
  update();
  state.body.posture = world::Posture::FallenBack;
  for (int i = 0; i < 60; ++i) update();
  ASSERT_TRUE(motion.fall().rising());
  state.body.posture = world::Posture::Upright;
  state.body.putUpright = true;
  update();
  EXPECT_FALSE(motion.fall().active());
  EXPECT_FALSE(motion.state().rising);
  state.body.putUpright = false;
  for (int i = 0; i < 100; ++i) update();
  EXPECT_FALSE(motion.fall().active());
}

}  // namespace
}  // namespace nonet::motion
