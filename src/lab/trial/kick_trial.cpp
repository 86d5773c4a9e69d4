#include "nonet/lab/trial/kick_trial.h"

#include <algorithm>
#include <cmath>

#include "nonet/world/ball_law.h"

namespace nonet::lab {

namespace {

using model::Side;
using motion::MotionRequest;

// Where the ball lies, seen from the standing robot, and how far off it may be.
constexpr double kAhead = 0.18;  // m
constexpr double kAside = 0.055;
constexpr double kAheadSpread = 0.03;
constexpr double kAsideSpread = 0.02;
constexpr double kBelief = 0.005;  // m, standard deviation of what the robot is told

constexpr double kLongestKick = 3.0;  // s
constexpr double kRollsOut = 8.0;     // s, for the ball
constexpr double kLasts = 1.0;        // s that the robot must stand after the skill
constexpr double kMiss = 0.3;         // m

world::BallMotion ballOf(RobotTrial& trial) {
  return {trial.physics().ballPosition().cast<double>(), trial.physics().ballVelocity().cast<double>()};
}

void putBall(RobotTrial& trial, const Vector2& place) {
  const double radius = trial.physics().settings().ballRadius;
  trial.physics().setBallPosition(Vector3(place.x(), place.y(), radius).cast<float>());
  trial.physics().setBallVelocity(sim::Vector3f::Zero());
}

// The last steps to a ball: slow, in any direction.
void walkAbout(RobotTrial& trial, Random& random) {
  const Pose2 velocity(random.uniform(-0.1, 0.2), random.uniform(-0.15, 0.15), random.uniform(-0.5, 0.5));
  const motion::WalkVelocity walk{velocity};
  trial.run(walk, random.uniform(1.0, 2.0));
}

}  // namespace

bool Kick::missed() const {
  return forward < kMiss;
}
double Kick::direction() const {
  return std::atan2(aside, forward);
}

Kick kickOnce(const TrialSetup& setup, Side side, KickFrom from, std::uint64_t seed) {
  TrialSetup own = setup;
  own.seed = seed;
  RobotTrial trial(own);
  Random random(seed);
  trial.settle(Pose2(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-kPi, kPi)));
  const double sign = side == Side::Left ? 1.0 : -1.0;
  const Vector2 ball(kAhead + random.uniform(-kAheadSpread, kAheadSpread),
                     sign * (kAside + random.uniform(-kAsideSpread, kAsideSpread)));
  if (from == KickFrom::Walk) walkAbout(trial, random);
  motion::KickTo request;
  request.foot = side;
  request.ball = ball + Vector2(random.normal(0.0, kBelief), random.normal(0.0, kBelief));
  request.target = Vector2(10.0, 0.0);
  Kick kick;
  const double begin = trial.time();
  const auto watch = [&] {
    kick.ballSpeed = std::max(kick.ballSpeed, static_cast<double>(trial.physics().ballVelocity().norm()));
    kick.fell = kick.fell || trial.down();
  };
  Pose2 start;
  bool begun = false;
  while (trial.time() - begin < kLongestKick && !trial.motion().state().skillFinished) {
    if (!begun) {
      start = trial.pose();
      putBall(trial, start * ball);  // until the kick begins it lies where it should, wherever the feet go
    }
    trial.step(request);
    begun = begun || trial.motion().state().busy;
    watch();
  }
  kick.duration = trial.time() - begin;
  while (trial.time() - begin < kick.duration + kRollsOut) {
    trial.step(MotionRequest{});
    watch();
    const bool settled = trial.time() - begin > kick.duration + kLasts;
    if (settled && (kick.fell || !world::isFlying(ballOf(trial)))) break;
  }
  // The rest of a roll is certain.
  const Vector2 way = start.inverse() * world::restPlace(ballOf(trial)) - ball;
  kick.forward = way.x();
  kick.aside = way.y();
  return kick;
}

}  // namespace nonet::lab
