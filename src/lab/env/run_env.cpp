// run: the learner gives a target angle of every joint in every cycle, on the physics alone. Episodes differ
// by how the robot has come to stand: its joints are a little off at first.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "nonet/lab/trial/robot_trial.h"
#include "nonet/math/random.h"
#include "nonet/motion/walk/engine.h"

#include "lab/env/envs.h"

namespace nonet::lab {

namespace {

constexpr double kMostAngle = 1.2;  // rad from the stand for an action of 1
constexpr double kShaken = 0.05;    // rad that a joint is off at first
constexpr double kShakes = 0.2;     // s
constexpr double kLongest = 10.0;   // s
constexpr double kRunFall = 1.0;    // of reward
constexpr double kForce = 50.0;     // N, shown as 1
constexpr std::size_t kBody = 14;   // numbers beside the joints' angles and speeds

class RunEnv final : public Env {
 public:
  explicit RunEnv(const EnvSettings& settings)
      : setup_(onOpenGround(trialSettings(settings.agent))),
        model_(model::robotModel(settings.agent.robotType)) {
    setup_.physics.solver =
        settings.server.quickSolver ? sim::WorldSettings::Solver::Quick : sim::WorldSettings::Solver::Exact;
    stand_ =
        motion::WalkEngine::standAngles(model_, setup_.motion.sets.of(setup_.motion.selection.standSet()));
  }

  std::size_t observations() const override { return 2 * model_.joints().size() + kBody; }
  std::size_t actions() const override { return model_.joints().size(); }
  double secondsPerStep() const override { return kCycleTime; }

  void reset(std::uint64_t seed) override {
    setup_.seed = seed;
    trial_ = std::make_unique<RobotTrial>(setup_);
    trial_->settle({});
    shake(Random(seed));
    begin_ = trial_->time();
    way_ = wayMade();
  }

  // Reward: metres ahead, less those aside.
  EnvStep step(std::span<const float> action) override {
    trial_->stepJoints(offStand([&action, i = std::size_t{0}]() mutable {
      return kMostAngle * std::clamp(static_cast<double>(action[i++]), -1.0, 1.0);
    }));
    const double way = wayMade();
    const double reward = way - way_;
    way_ = way;
    if (trial_->down()) return {reward - kRunFall, true, false};
    const bool timeUp = trial_->time() - begin_ > kLongest;
    return {reward, timeUp, timeUp};
  }

  // Angles from the stand in rad, speeds in 0.1 rad/s, lean, gyro, accelerometer in g, feet.
  void observe(std::span<float> observation) const override {
    const world::BodyState& body = trial_->belief().body;
    std::size_t i = 0;
    const auto show = [&](double value) { observation[i++] = static_cast<float>(value); };
    for (const model::JointSpec& joint : model_.joints())
      show(body.joints[model::index(joint.id)] - stand_[model::index(joint.id)]);
    for (const model::JointSpec& joint : model_.joints())
      show(0.1 * body.jointSpeeds[model::index(joint.id)]);
    show(body.roll);
    show(body.pitch);
    for (const double rate : body.gyro) show(rate);
    for (const double acceleration : body.accelerometer) show(acceleration / 9.81);
    for (const bool contact : body.footContact) show(contact ? 1.0 : 0.0);
    for (const Vector3& force : body.footForce) show(force.z() / kForce);
    show(std::sin(trial_->pose().rotation));
    show(trial_->pose().translation.y());
  }

 private:
  /// The stand with every joint off by what `offset` gives, joint by joint, within its stops.
  template <class Offset>
  motion::JointTargets offStand(Offset offset) const {
    motion::JointTargets targets;
    targets.angles = stand_;
    targets.stiffness.fill(1.0);
    for (const model::JointSpec& joint : model_.joints()) {
      double& angle = targets.angles[model::index(joint.id)];
      angle = std::clamp(angle + offset(), joint.low, joint.high);
    }
    return targets;
  }

  void shake(Random random) {
    const motion::JointTargets targets = offStand([&] { return random.uniform(-kShaken, kShaken); });
    for (double time = 0.0; time < kShakes; time += kCycleTime) trial_->stepJoints(targets);
  }

  // m ahead, less those aside.
  double wayMade() const {
    const Vector2 place = trial_->pose().translation;
    return place.x() - std::abs(place.y());
  }

  TrialSettings setup_;
  const model::RobotModel& model_;
  model::JointArray stand_{};
  std::unique_ptr<RobotTrial> trial_;
  double begin_ = 0.0;  // s
  double way_ = 0.0;    // m
};

}  // namespace

std::unique_ptr<Env> makeRunEnv(const EnvSettings& settings) {
  return std::make_unique<RunEnv>(settings);
}

}  // namespace nonet::lab
