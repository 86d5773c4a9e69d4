// A trial must not differ from play: its messages are compared with those that the whole simulation gives to
// an agent in the same state.
#include "nonet/lab/trial/robot_trial.h"

#include <gtest/gtest.h>

#include "nonet/math/random.h"
#include "nonet/sim/simulation.h"

#include "lab/trial_setup.h"

namespace nonet::lab {
namespace {

// One agent in the whole simulation; commands as a client would give them.
class Player {
 public:
  Player(const sim::Settings& settings, int type) : simulation_(settings, 1) {
    protocol::SceneEffector scene;
    scene.robotType = type;
    protocol::InitEffector init;
    init.unum = 2;
    init.team.assign("Nonet");
    agent_ = simulation_.enter(scene, init);
    for (int i = 0; i < 60; ++i) simulation_.step();
  }

  std::vector<std::uint8_t> savePhysics() const { return simulation_.world().save(); }
  sim::RobotHandle robot() const { return simulation_.agents().front().robot; }

  const protocol::Percept& sense() {
    simulation_.step();
    return *simulation_.sense(agent_);
  }
  void act(const model::RobotModel& model, const model::JointArray& speeds) {
    protocol::Effectors effectors;
    for (const model::JointSpec& joint : model.joints())
      effectors.setSpeed(joint.id, speeds[model::index(joint.id)]);
    simulation_.act(agent_, effectors);
  }

 private:
  sim::Simulation simulation_;
  sim::AgentHandle agent_ = sim::kNoAgent;
};

void expectSame(const protocol::Percept& a, const protocol::Percept& b) {
  EXPECT_EQ(a.gyro, b.gyro);
  EXPECT_EQ(a.accelerometer, b.accelerometer);
  EXPECT_EQ(a.jointsPresent, b.jointsPresent);
  EXPECT_EQ(a.joints, b.joints);
  for (std::size_t i = 0; i < a.forces.size(); ++i) {
    ASSERT_EQ(a.forces[i].has_value(), b.forces[i].has_value());
    if (!a.forces[i]) continue;
    EXPECT_EQ(a.forces[i]->center, b.forces[i]->center);
    EXPECT_EQ(a.forces[i]->force, b.forces[i]->force);
  }
}

class RobotTrialSenses : public testing::TestWithParam<int> {};

TEST_P(RobotTrialSenses, AreThoseOfTheSimulation) {
  const sim::Settings settings;
  Player player(settings, GetParam());
  TrialSettings setup = agentTrialSettings(GetParam());
  setup.physics = settings.world();
  RobotTrial trial(setup);
  ASSERT_EQ(trial.robot(), player.robot());
  trial.restorePhysics(player.savePhysics());
  Random random(5);
  model::JointArray speeds{};
  int contacts = 0;
  for (int cycle = 0; cycle < 200; ++cycle) {
    if (cycle % 8 == 0) {
      for (double& speed : speeds) speed = random.uniform(-3.0, 3.0);
    }
    trial.stepSpeeds(speeds);
    const protocol::Percept& percept = player.sense();
    expectSame(trial.percept(), percept);
    if (HasFailure()) FAIL() << "cycle " << cycle;
    player.act(trial.model(), speeds);
    for (const auto& force : percept.forces) contacts += force ? 1 : 0;
  }
  EXPECT_GT(contacts, 50);
}

INSTANTIATE_TEST_SUITE_P(Types, RobotTrialSenses, testing::Values(0, 4));

}  // namespace
}  // namespace nonet::lab
