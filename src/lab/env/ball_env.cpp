// dribble, receive: the learner steers the walk of a robot that sees the ball with its own eyes. What it is
// shown is what the robot believes; rewards are by the truth.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "nonet/math/random.h"

#include "lab/env/envs.h"
#include "lab/trial/ball_drill.h"

namespace nonet::lab {

namespace {

constexpr int kCycles = 3;                       // a step: from one sight to the next
constexpr std::array kMostSpeed{1.5, 0.8, 3.0};  // m/s, m/s, rad/s for an action of 1
constexpr std::size_t kObservations = 14;
constexpr double kFarthest = 5.0;  // m shown
constexpr double kBallFall = 1.0;  // of reward
constexpr double kGone = 1.5;      // m, a ball that is lost for good

motion::HeadRequest watch(const world::WorldState& world) {
  motion::HeadRequest head;
  if (!world.ball.known) return head;
  head.kind = motion::HeadRequest::Kind::Point;
  head.p_RP = Vector3(world.ball.p_RB.x(), world.ball.p_RB.y(), world.ball.p_FB.z() - world.self.height);
  return head;
}

class BallEnv : public Env {
 public:
  explicit BallEnv(EnvSettings settings) : settings_(std::move(settings)) {}

  std::size_t observations() const override { return kObservations; }
  std::size_t actions() const override { return kMostSpeed.size(); }
  double secondsPerStep() const override { return kCycles * kCycleTime; }

  void reset(std::uint64_t seed) override {
    Random random(seed);
    const BallScene scene = draw(random);
    target_ = scene.target;
    speed_ = std::make_shared<Pose2>();
    GameSituation situation = scene.situation;
    situation.players = {fieldPlayer(settings_.agent, scene.start, mind())};
    trial_ = std::make_unique<RecordedTrial>(settings_.server, situation, random.next());
    begin(scene);
  }

  EnvStep step(std::span<const float> action) override {
    const auto speed = [&](std::size_t i) {
      return kMostSpeed[i] * std::clamp(static_cast<double>(action[i]), -1.0, 1.0);
    };
    *speed_ = Pose2(speed(0), speed(1), speed(2));
    for (int i = 0; i < kCycles; ++i) trial_->step();
    EnvStep result = judge();
    if (!trial_->game().down(0)) return result;
    return {result.reward - kBallFall, true, false};
  }

  // Robot frame: ball, its speed, the way from the ball to its target; the robot's speed and lean; how long
  // ago it saw the ball.
  void observe(std::span<float> observation) const override {
    const world::WorldState& world = trial_->game().belief(0);
    const Pose2 X_RF = world.self.X_FR.inverse();
    const Vector2 rolls = X_RF.rotate(world.ball.v_FB.head<2>());
    Vector2 way = X_RF * target_ - world.ball.p_RB;
    way *= std::min(1.0, kFarthest / std::max(way.norm(), 1e-6));
    const Pose2& step = world.body.odometryStep;
    const double age = std::min(world.time - world.ball.lastSeen, 2.0);
    const std::array<double, kObservations> values{std::clamp(world.ball.p_RB.x(), -kFarthest, kFarthest),
                                                   std::clamp(world.ball.p_RB.y(), -kFarthest, kFarthest),
                                                   rolls.x(),
                                                   rolls.y(),
                                                   way.x(),
                                                   way.y(),
                                                   step.translation.x() / kCycleTime,
                                                   step.translation.y() / kCycleTime,
                                                   step.rotation / kCycleTime,
                                                   world.body.roll,
                                                   world.body.pitch,
                                                   world.body.gyro.x(),
                                                   world.body.gyro.y(),
                                                   age};
    std::transform(values.begin(), values.end(), observation.begin(),
                   [](double value) { return static_cast<float>(value); });
  }

 protected:
  virtual BallScene draw(Random& random) const = 0;
  virtual void begin(const BallScene& scene) = 0;
  /// Of the step that was just made.
  virtual EnvStep judge() = 0;
  RecordedTrial& trial() { return *trial_; }

 private:
  Mind mind() const {
    return [speed = speed_](const world::WorldState& world, const motion::MotionState& motion) {
      team::Action action;
      if (!motion.rising) action.motion = motion::WalkVelocity{*speed};
      action.head = watch(world);
      return action;
    };
  }

  EnvSettings settings_;
  Vector2 target_ = Vector2::Zero();
  std::shared_ptr<Pose2> speed_;
  std::unique_ptr<RecordedTrial> trial_;
};

// Reward: metres of the line that the ball has made in the step, less 0.02 while it is lost.
class DribbleEnv final : public BallEnv {
 public:
  using BallEnv::BallEnv;

 private:
  static constexpr double kAway = 0.02;
  static constexpr double kLongest = 30.0;  // s

  BallScene draw(Random& random) const override { return dribbleScene(random); }
  void begin(const BallScene& scene) override {
    path_ = scene.path;
    made_ = 0.0;
  }
  EnvStep judge() override {
    const BallSample& now = trial().track().back();
    const Vector2 way = (path_.corners[1] - path_.corners[0]).normalized();
    const Vector2 from = now.ball - path_.corners[0];
    const double made = from.dot(way);
    const double aside = (from - made * way).norm();
    const double apart = (now.ball - now.X_WR.translation).norm();
    const bool away = aside > path_.width || apart > path_.keep;
    const double reward = made - made_ - (away ? kAway : 0.0);
    made_ = made;
    const bool over = made > path_.length() || apart > kGone || aside > kGone || !trial().playsOn();
    const bool timeUp = !over && trial().game().time() > kLongest;
    return {reward, over || timeUp, timeUp};
  }

  BallPath path_;
  double made_ = 0.0;  // m
};

// Reward at the end, also where only the time was up: 1 for a pass that is held, otherwise minus its rebound.
class ReceiveEnv final : public BallEnv {
 public:
  using BallEnv::BallEnv;

 private:
  static constexpr double kLongest = 4.0;  // s

  BallScene draw(Random& random) const override { return passScene(random); }
  void begin(const BallScene& /*scene*/) override {}
  EnvStep judge() override {
    const ReceiveResult result = measureReceive(trial().track(), ReceiveRule{});
    const bool over = result.held || !trial().playsOn();
    const bool timeUp = !over && trial().game().time() > kLongest;
    if (!over && !timeUp) return {};
    return {result.held ? 1.0 : -std::min(result.rebound, 1.0), true, timeUp};
  }
};

}  // namespace

std::unique_ptr<Env> makeDribbleEnv(const EnvSettings& settings) {
  return std::make_unique<DribbleEnv>(settings);
}
std::unique_ptr<Env> makeReceiveEnv(const EnvSettings& settings) {
  return std::make_unique<ReceiveEnv>(settings);
}

}  // namespace nonet::lab
