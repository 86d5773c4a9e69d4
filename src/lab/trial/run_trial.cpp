#include "nonet/lab/trial/run_trial.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "nonet/lab/trial/push.h"
#include "nonet/math/angle.h"
#include "nonet/math/direction.h"
#include "nonet/math/random.h"
#include "nonet/model/ball.h"

namespace nonet::lab {

namespace {

constexpr double kExploded = 140.0;  // m from its middle

constexpr double kRunTime = 2.5;        // s
constexpr double kFastAfter = 1.5;      // s
constexpr double kAway = 10.0;          // m, of the target
constexpr double kAside = 0.1;          // rad, of the target in the beginning
constexpr double kJump = 0.25;          // rad, of a target that jumps
constexpr double kNoise = 0.02;         // rad, of its direction
constexpr double kNoiseKept = 0.9;      // from cycle to cycle
constexpr double kPush = 0.1;           // m/s
constexpr double kPushEvery = 1.5;      // s, on average
constexpr double kAfterwards = 1.5;     // s, of what follows
constexpr double kChaseTime = 8.0;      // s
constexpr double kLeap = 0.8;           // rad, of a target that is chased; every fifth leap
constexpr double kFarLeap = 3.0;        // rad, goes up to here
constexpr double kLeapEvery = 2.0;      // s, on average
constexpr double kCrowdEvery = 4.0;     // s, on average: then somebody is near,
constexpr double kCrowdTime = 1.0;      // s, for up to so long
constexpr double kTilt = 0.5;           // rad
constexpr double kSurelyFalling = 0.9;  // rad
constexpr double kStill = 0.08;         // m/s
constexpr std::size_t kSpeedOver = 6;   // cycles

int cyclesIn(double seconds) {
  return static_cast<int>(std::lround(seconds / kCycleTime));
}

TrialSettings openGround(TrialSettings setup, std::uint64_t seed) {
  setup = onOpenGround(std::move(setup));
  setup.seed = seed;
  return setup;
}

class Runner {
 public:
  Runner(const TrialSettings& setup, std::uint64_t seed)
      : random_(Random(seed).fork(9)), trial_(openGround(setup, seed)) {}

  RunOutcome run() {
    begin();
    const int cycles = cyclesIn(kRunTime);
    const int jump = random_.below(3) == 0 ? cyclesIn(random_.uniform(0.8, 2.0)) : cycles;
    Vector2 from = start_;
    for (int i = 0; i < cycles; ++i) {
      if (i == jump) turnTarget();
      if (random_.uniform() < kCycleTime / kPushEvery) push();
      trial_.step(towardsTarget());
      if (i + 1 == cyclesIn(kFastAfter)) from = trial_.pose().translation;
      if (lies()) {
        outcome_.fell = true;
        outcome_.fellAt = static_cast<double>(i) / cycles;
        break;
      }
      feelTilt();
    }
    outcome_.speed = along(start_) / kRunTime;
    if (outcome_.fell) return outcome_;
    outcome_.fast = along(from) / (kRunTime - kFastAfter);
    random_.below(3) == 0 ? walkOn() : stop();
    return outcome_;
  }

  RunOutcome chase(double hardness) {
    hardness_ = hardness;
    begin();
    const int cycles = cyclesIn(kChaseTime);
    double way = 0.0, fastWay = 0.0;
    for (int i = 0; i < cycles && !outcome_.fell; ++i) {
      const Vector2 before = trial_.pose().translation;
      trial_.step(followedTarget());
      const double made = (trial_.pose().translation - before).dot(unitVector(direction_));
      way += made;
      if (i >= cyclesIn(kFastAfter)) fastWay += made;
      feelTilt();
      outcome_.fell = lies();
      if (outcome_.fell) outcome_.fellAt = static_cast<double>(i) / cycles;
    }
    outcome_.speed = way / kChaseTime;
    if (!outcome_.fell) outcome_.fast = fastWay / (kChaseTime - kFastAfter);
    return outcome_;
  }

 private:
  // A quarter each out of a walk in any direction and of one ahead, the rest out of a stand.
  void begin() {
    trial_.settle({random_.uniform(-1.0, 1.0), random_.uniform(-1.0, 1.0), random_.uniform(-kPi, kPi)});
    const std::uint64_t kind = random_.below(4);
    Pose2 speed(1.2, 0.0, 0.0);
    if (kind == 2) {
      const double ahead = random_.uniform(-0.6, 1.2);
      const double aside = random_.uniform(-0.5, 0.5);
      speed = Pose2(ahead, aside, random_.uniform(-1.5, 1.5));
    }
    const double time = random_.uniform(0.3, 1.1);
    if (kind >= 2) trial_.run(motion::WalkVelocity{speed}, time);
    const Pose2 pose = trial_.pose();
    start_ = pose.translation;
    direction_ = pose.rotation + random_.uniform(-kAside, kAside);
    target_ = start_ + kAway * unitVector(direction_);
  }

  void turnTarget() {
    const double turned = direction_ + random_.uniform(-kJump, kJump);
    target_ = trial_.pose().translation + kAway * unitVector(turned);
  }

  void leapTarget() {
    const double most = random_.below(5) == 0 ? kFarLeap : kLeap;
    direction_ += hardness_ * random_.uniform(-most, most);
    target_ = trial_.pose().translation + kAway * unitVector(direction_);
  }

  // What happens to somebody who follows the ball: the target leaps, others bump into it, or are so near that
  // it walks with more care for a while.
  motion::MotionRequest followedTarget() {
    if (random_.uniform() < kCycleTime / kLeapEvery) leapTarget();
    if (random_.uniform() < kCycleTime / kPushEvery) push();
    if (random_.uniform() < kCycleTime / kCrowdEvery) {
      crowded_ = cyclesIn(hardness_ * random_.uniform(0.0, kCrowdTime));
    }
    motion::WalkTo request = towardsTarget();
    if (crowded_ > 0) request.set = motion::WalkSet::Positioning;
    crowded_ = std::max(0, crowded_ - 1);
    return request;
  }

  motion::WalkTo towardsTarget() {
    noise_ = kNoiseKept * noise_ +
             std::sqrt(1.0 - kNoiseKept * kNoiseKept) * hardness_ * kNoise * random_.normal();
    const double bearing = directionOf(trial_.pose().inverse() * target_) + noise_;
    return motion::WalkTo{Pose2(kAway * unitVector(bearing), bearing), false};
  }

  void push() { pushRobot(trial_.physics(), trial_.robot(), hardness_ * kPush, random_); }

  void stop() {
    std::array<Vector2, kSpeedOver> before;
    before.fill(trial_.pose().translation);
    const int cycles = cyclesIn(kAfterwards);
    for (int i = 0; i < cycles && !outcome_.fellAfter; ++i) {
      trial_.step(motion::Stand{});
      Vector2& then = before[static_cast<std::size_t>(i) % kSpeedOver];
      const Vector2 now = trial_.pose().translation;
      if ((now - then).norm() > kStill * kSpeedOver * kCycleTime) outcome_.stopTime = (i + 1) * kCycleTime;
      then = now;
      feelTilt();
      outcome_.fellAfter = lies();
    }
  }

  void walkOn() {
    const double angle = random_.uniform(-1.5, 1.5);
    const motion::WalkVelocity walk{Pose2(0.8 * std::cos(angle), 0.5 * std::sin(angle), 0.0)};
    const int cycles = cyclesIn(kAfterwards);
    for (int i = 0; i < cycles && !outcome_.fellAfter; ++i) {
      trial_.step(walk);
      feelTilt();
      outcome_.fellAfter = lies();
    }
  }

  double along(const Vector2& from) const {
    return (trial_.pose().translation - from).dot(unitVector(direction_));
  }
  // Absurd parameters can drive the solver to numbers that are none.
  bool lies() const {
    const Vector3 torso = trial_.torsoPosition();
    return !torso.allFinite() || torso.norm() > kExploded || trial_.down();
  }
  void feelTilt() {
    outcome_.unsteadiness += kCycleTime * std::pow(std::min(trial_.tilt(), kSurelyFalling) / kTilt, 4);
  }

  Random random_;
  RobotTrial trial_;
  RunOutcome outcome_;
  Vector2 start_ = Vector2::Zero();   // m
  Vector2 target_ = Vector2::Zero();  // m
  double direction_ = 0.0;            // rad
  double noise_ = 0.0;                // rad
  double hardness_ = 1.0;             // of all that disturbs
  int crowded_ = 0;                   // cycles that it stays so
};

}  // namespace

RunOutcome runAhead(const TrialSettings& setup, std::uint64_t seed) {
  return Runner(setup, seed).run();
}

RunOutcome runAfter(const TrialSettings& setup, std::uint64_t seed, double hardness) {
  return Runner(setup, seed).chase(hardness);
}

}  // namespace nonet::lab
