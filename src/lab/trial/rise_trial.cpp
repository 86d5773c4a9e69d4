#include "nonet/lab/trial/rise_trial.h"

#include <cmath>
#include <string_view>

#include "nonet/math/random.h"
#include "nonet/sim/referee/self_collision.h"

#include "lab/trial/any_pose.h"

namespace nonet::lab {

namespace {

using model::JointId;
using motion::MotionRequest;
using world::Posture;

constexpr double kLongestRise = 12.0;  // s: the referee takes a field player away after 15 s on the ground
constexpr double kRisenLasts = 0.6;    // s that a stand must last
constexpr double kTipped = 0.5;        // rad: from here on the robot falls

bool matches(Posture posture, FallKind kind) {
  switch (kind) {
    case FallKind::Front:
      return posture == Posture::FallenFront;
    case FallKind::Back:
      return posture == Posture::FallenBack;
    case FallKind::Side:
      return world::isFallen(posture);  // a dive may end on the back or the front too
  }
  return false;
}

// Leans in the given direction (0 = forward) by ankles and hips until the robot tips.
bool tip(RobotTrial& trial, double direction, Random& random) {
  motion::JointTargets targets;
  targets.angles = trial.belief().body.joints;
  targets.stiffness.fill(1.0);
  for (std::size_t i = model::index(JointId::RArm1); i < model::kJointCount; ++i) {
    targets.angles[i] += random.uniform(-0.2, 0.2);
  }
  const double lean = random.uniform(0.5, 0.8);
  const double ahead = lean * std::cos(direction);
  const double aside = lean * std::sin(direction);
  for (const JointId ankle : {JointId::LLeg5, JointId::RLeg5}) targets.angles[model::index(ankle)] += ahead;
  for (const JointId hip : {JointId::LLeg2, JointId::RLeg2}) targets.angles[model::index(hip)] += aside;
  if (ahead < 0.0) {
    for (const JointId hip : {JointId::LLeg3, JointId::RLeg3})
      targets.angles[model::index(hip)] += 0.5 * ahead;
  }
  for (int i = 0; i < 75; ++i) {
    trial.stepJoints(targets);
    if (trial.tilt() > kTipped) return true;
  }
  return false;
}

void dive(RobotTrial& trial, Random& random) {
  const model::Side side = random.below(2) == 0 ? model::Side::Left : model::Side::Right;
  const motion::PlaySkill request{std::string_view("dive"), side};
  for (int i = 0; i < 200 && !trial.motion().state().skillFinished; ++i) trial.step(request);
}

// Steps until the robot stands and stays up; fills what happened.
void rise(RobotTrial& trial, FallKind kind, Rise& result) {
  double lying = -1.0;
  double standing = -1.0;
  bool wasRising = false;
  const double begin = trial.time();
  while (trial.time() - begin < kLongestRise) {
    trial.step(MotionRequest{});
    const Posture posture = trial.belief().body.posture;
    if (lying < 0.0 && world::isFallen(posture)) lying = trial.time();
    const bool rising = trial.motion().fall().rising();
    if (rising && !wasRising) {
      if (result.attempts == 0) result.fell = matches(posture, kind);
      ++result.attempts;
    }
    wasRising = rising;
    if (sim::selfCollides(trial.physics(), trial.robot())) result.collided += kCycleTime;
    const bool up = lying >= 0.0 && !trial.down() && trial.tilt() < 0.2 && !trial.motion().state().rising;
    if (!up) standing = -1.0;
    if (up && standing < 0.0) standing = trial.time();
    if (up && trial.time() - standing >= kRisenLasts) {
      result.stands = true;
      result.time = standing - lying;
      return;
    }
  }
}

}  // namespace

Rise fallAndRise(const TrialSettings& setup, FallKind kind, std::uint64_t seed) {
  TrialSettings own = setup;
  own.seed = seed;
  RobotTrial trial(own);
  Random random(seed);
  trial.settle(anyPose(random, kPi));
  motion::WalkVelocity walk;
  walk.velocity = anyPose(random, 2.0);  // m/s, rad/s
  trial.run(walk, random.uniform(0.0, 1.5));
  Rise result;
  if (kind == FallKind::Side) {
    dive(trial, random);
  } else {
    const double direction = (kind == FallKind::Front ? 0.0 : kPi) + random.uniform(-0.8, 0.8);
    if (!tip(trial, direction, random)) return result;
  }
  rise(trial, kind, result);
  return result;
}

}  // namespace nonet::lab
