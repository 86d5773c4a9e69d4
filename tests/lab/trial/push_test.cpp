#include "nonet/lab/trial/push.h"

#include <gtest/gtest.h>

#include "nonet/lab/trial/robot_trial.h"
#include "nonet/model/robot_model.h"

#include "lab/trial_setup.h"

namespace nonet::lab {
namespace {

TEST(Push, MakesAllBodiesFasterAlike) {
  RobotTrial trial(agentTrialSettings(2));
  sim::World& world = trial.physics();
  Random random(3);
  for (int i = 0; i < 50; ++i) {
    std::vector<Eigen::Vector3d> before;
    for (const model::BodySpec& body : trial.model().bodies())
      before.push_back(world.bodyState(trial.robot(), body.id).velocity);
    pushRobot(world, trial.robot(), 0.4, random);
    std::size_t at = 0;
    Eigen::Vector3d first = Eigen::Vector3d::Zero();
    for (const model::BodySpec& body : trial.model().bodies()) {
      const Eigen::Vector3d change = world.bodyState(trial.robot(), body.id).velocity - before[at];
      if (at++ == 0) first = change;
      EXPECT_LE((change - first).norm(), 1e-12);
      EXPECT_EQ(change.z(), 0.0);
      EXPECT_LE(change.norm(), 0.4 + 1e-12);
    }
    EXPECT_GT(first.norm(), 0.0);
  }
}

}  // namespace
}  // namespace nonet::lab
