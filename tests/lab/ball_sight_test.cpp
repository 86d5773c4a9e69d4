// The whole world stage in the simulation: a robot that stands on the field and sees a rolling ball.
#include <algorithm>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "nonet/math/random.h"
#include "nonet/sim/simulation.h"
#include "nonet/world/ball_law.h"
#include "nonet/world/world_model.h"

namespace nonet::lab {
namespace {

class Watcher {
 public:
  explicit Watcher(std::uint64_t seed)
      : simulation_({}, seed), world_(model::robotModel(0), {}, protocol::TeamName("Us"), seed) {
    protocol::SceneEffector scene;
    protocol::InitEffector init;
    init.unum = 1;
    init.team.assign("Us");
    agent_ = simulation_.enter(scene, init);
    for (int i = 0; i < 5; ++i) step();
    protocol::Effectors beam;
    beam.beam = Pose2(-8.0, 0.0, 0.0);
    simulation_.act(agent_, beam);
    for (int i = 0; i < 100; ++i) step();
    simulation_.trainer("(playMode PlayOn)");
  }

  void step() {
    if (const protocol::Percept* percept = simulation_.sense(agent_)) {
      world_.update(*percept);
      // A turning head keeps the robot awake.
      protocol::Effectors effectors;
      effectors.setSpeed(model::JointId::Head1, ++cycles_ / 25 % 2 == 0 ? 0.5 : -0.5);
      simulation_.act(agent_, effectors);
    }
    simulation_.step();
  }

  void roll(const Vector2& p_WB, const Vector2& v_WB) {
    simulation_.trainer(
        fmt::format("(ball (pos {} {} 0.042)(vel {} {} 0))", p_WB.x(), p_WB.y(), v_WB.x(), v_WB.y()));
  }
  Vector2 ball() const { return simulation_.world().ballPosition().head<2>().cast<double>(); }
  const world::WorldState& world() const { return world_.state(); }

 private:
  sim::Simulation simulation_;
  world::WorldModel world_;
  sim::AgentHandle agent_ = sim::kNoAgent;
  int cycles_ = 0;
};

TEST(BallInSight, RestOfARollIsForeseenAfterAThirdOfASecond) {
  std::vector<double> restErrors;
  std::vector<double> errors;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Watcher watcher(seed);
    Random random(seed);
    watcher.roll({random.uniform(-5.5, -3.5), random.uniform(-1.5, 1.5)}, {0.0, 0.0});
    for (int i = 0; i < 50; ++i) watcher.step();
    const double direction = random.uniform(-kPi, kPi);
    watcher.roll(watcher.ball(), 4.0 * Vector2(std::cos(direction), std::sin(direction)));
    Vector2 rest = Vector2::Zero();
    Vector2 shown = watcher.ball();
    for (int cycle = 0; cycle < 500; ++cycle) {
      const Vector2 before = watcher.ball();
      watcher.step();
      // The message just read shows the ball as it was a cycle before.
      if (cycle == 16) rest = world::restPlace({watcher.world().ball.p_FB, watcher.world().ball.v_FB});
      const bool near = (watcher.world().self.X_FR.translation - shown).norm() < 5.0;
      if (near && watcher.world().ball.lastSeen == watcher.world().time) {
        errors.push_back((watcher.world().ball.p_FB.head<2>() - shown).norm());
      }
      shown = before;
    }
    restErrors.push_back((rest - watcher.ball()).norm());
  }
  std::sort(restErrors.begin(), restErrors.end());
  std::sort(errors.begin(), errors.end());
  ASSERT_GT(errors.size(), 1000U);
  const double medianError = errors[errors.size() / 2];
  RecordProperty("medianBallError", fmt::format("{:.4f}", medianError));
  RecordProperty("medianRestError", fmt::format("{:.3f}", restErrors[restErrors.size() / 2]));
  RecordProperty("largestRestError", fmt::format("{:.3f}", restErrors.back()));
  EXPECT_LT(medianError, 0.05);
  EXPECT_LT(restErrors[restErrors.size() * 19 / 20 - 1], 0.5);
}

}  // namespace
}  // namespace nonet::lab
