// Speeds that nothing has in a match do not last: they would grow until ODE ends the process.
#include <gtest/gtest.h>

#include "nonet/sim/physics/world.h"

namespace nonet::sim {
namespace {

double fastest(const World& world, RobotHandle robot) {
  double speed = 0.0;
  for (const model::BodyId body : {model::BodyId::Torso, model::BodyId::Head, model::BodyId::LFoot})
    speed = std::max(speed, world.bodyState(robot, body).velocity.norm());
  return speed;
}

void hurl(World& world, RobotHandle robot, double speed) {
  World::BodyState state = world.bodyState(robot, model::BodyId::Torso);
  state.velocity.z() = speed;
  world.setBodyState(robot, model::BodyId::Torso, state);
}

class Containment : public testing::TestWithParam<WorldSettings::Solver> {
 protected:
  Containment() {
    WorldSettings settings;
    settings.solver = GetParam();
    world_ = std::make_unique<World>(settings);
    robot_ = world_->addRobot(0);
    world_->moveRobot(robot_, Vector3f(3.0F, 0.0F, 0.4F));
    other_ = world_->addRobot(1);
    world_->moveRobot(other_, Vector3f(-3.0F, 0.0F, 0.4F));
    for (int i = 0; i < 50; ++i) step();
  }
  void step() {
    world_->prePhysics();
    world_->stepPhysics();
  }
  std::unique_ptr<World> world_;
  RobotHandle robot_ = kNoRobot;
  RobotHandle other_ = kNoRobot;
};

TEST_P(Containment, WhatIsFasterThanAnythingStandsStillAndNobodyElse) {
  hurl(*world_, robot_, 1e5);
  hurl(*world_, other_, 2.0);
  step();
  EXPECT_EQ(fastest(*world_, robot_), 0.0);
  EXPECT_GT(fastest(*world_, other_), 0.01);
  for (int i = 0; i < 100; ++i) step();
  EXPECT_LT(fastest(*world_, robot_), 20.0);
  EXPECT_TRUE(world_->bodyState(robot_, model::BodyId::Torso).position.allFinite());
}

TEST_P(Containment, WhatAMatchKnowsGoesOn) {
  hurl(*world_, robot_, 12.0);
  step();
  EXPECT_GT(fastest(*world_, robot_), 0.1);
}

INSTANTIATE_TEST_SUITE_P(Solvers, Containment,
                         testing::Values(WorldSettings::Solver::Exact, WorldSettings::Solver::Quick));

}  // namespace
}  // namespace nonet::sim
