#include "nonet/lab/trial/dive_trial.h"

#include <algorithm>
#include <string_view>

namespace nonet::lab {

namespace {

using model::Side;
using motion::MotionRequest;

constexpr double kLow = 0.12;         // m: a part whose middle is below it stops a rolling ball
constexpr double kLongestDive = 4.0;  // s
constexpr double kLongestRise = 12.0;
constexpr double kLasts = 0.6;    // s that a stand must last
constexpr double kUpright = 0.2;  // rad

double reachOf(RobotTrial& trial, const Pose2& start, Side side) {
  const double sign = side == Side::Left ? 1.0 : -1.0;
  double reach = 0.0;
  for (const model::BodySpec& body : trial.model().bodies()) {
    if (!body.collider) continue;
    const Vector3 p_F = trial.physics().bodyPosition(trial.robot(), body.id).cast<double>();
    if (p_F.z() < kLow) reach = std::max(reach, sign * (start.inverse() * Vector2(p_F.head<2>())).y());
  }
  return reach;
}

void rise(RobotTrial& trial, Dive& dive) {
  const double begin = trial.time();
  double since = begin;
  while (trial.time() - begin < kLongestRise) {
    trial.step(MotionRequest{});
    dive.attempts = std::max(dive.attempts, trial.motion().fall().attempts());
    const bool up = trial.tilt() < kUpright && !trial.down() && !trial.motion().state().rising;
    if (!up) since = trial.time();
    if (trial.time() - since < kLasts) continue;
    dive.stands = true;
    dive.riseTime = since - begin;
    return;
  }
}

}  // namespace

Dive diveAndRise(const TrialSetup& setup, Side side, std::uint64_t seed) {
  TrialSetup own = setup;
  own.seed = seed;
  RobotTrial trial(own);
  Random random(seed);
  trial.settle(Pose2(0.0, 0.0, random.uniform(-kPi, kPi)));
  motion::WalkVelocity step;
  step.velocity = Pose2(0.0, random.uniform(-0.2, 0.2), random.uniform(-0.5, 0.5));
  trial.run(step, random.uniform(0.0, 0.6));  // a goalie is seldom quite still
  const Pose2 start = trial.pose();
  const motion::PlaySkill request{std::string_view("dive"), side};
  Dive dive;
  const double begin = trial.time();
  std::size_t next = 0;
  while (trial.time() - begin < kLongestDive && !trial.motion().state().skillFinished) {
    trial.step(request);
    if (next == Dive::kTimes.size() || trial.time() - begin < Dive::kTimes[next] - 1e-6) continue;
    dive.reach[next] = reachOf(trial, start, side);
    ++next;
  }
  rise(trial, dive);
  return dive;
}

}  // namespace nonet::lab
