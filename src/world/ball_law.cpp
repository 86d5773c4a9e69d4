#include "nonet/world/ball_law.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nonet::world {

namespace {

constexpr double kFlyingHeight = 0.075;  // m, above it the ball does not touch the ground
constexpr double kLiftSpeed = 0.35;      // m/s, a bounce below it ends in rolling
constexpr int kMaximumSteps = 300;       // of one cycle, for a flight

}  // namespace

bool isFlying(const BallMotion& ball) {
  return ball.p_FB.z() > kFlyingHeight || std::abs(ball.v_FB.z()) > kLiftSpeed;
}

double landingTime(const BallMotion& ball) {
  if (!isFlying(ball)) return 0.0;
  const double lift = ball.v_FB.z();
  const double height = std::max(0.0, ball.p_FB.z() - kBallRestHeight);
  return std::max(0.0, (lift + std::sqrt(lift * lift + 2.0 * kGravity * height)) / kGravity);
}

void stepBall(BallMotion& ball, double dt) {
  if (!isFlying(ball)) {
    // Exact solution of v' = -k v over the step.
    const double keep = std::exp(-kRollDecay * dt);
    ball.p_FB.head<2>() += (1.0 - keep) / kRollDecay * ball.v_FB.head<2>();
    ball.v_FB.head<2>() *= keep;
    ball.v_FB.z() = 0.0;
    ball.p_FB.z() += (kBallRestHeight - ball.p_FB.z()) * std::min(1.0, 15.0 * dt);
    return;
  }
  // The server's order: velocity first, then position with the new velocity.
  ball.v_FB -= dt * kAirDecay * ball.v_FB;
  ball.v_FB.z() -= dt * kGravity;
  ball.p_FB += dt * ball.v_FB;
  if (ball.p_FB.z() < kBallRestHeight && ball.v_FB.z() < 0.0) {
    ball.p_FB.z() = kBallRestHeight;
    const double up = -kBounce * ball.v_FB.z();
    ball.v_FB.z() = up > kLiftSpeed ? up : 0.0;
    ball.v_FB.head<2>() *= kBounceGrip;
  }
}

void moveBall(BallMotion& ball, double seconds) {
  while (seconds > 1e-9) {
    const double dt = isFlying(ball) ? std::min(seconds, kCycleTime) : seconds;
    stepBall(ball, dt);
    seconds -= dt;
  }
}

FreeBall::FreeBall(const BallMotion& ball) {
  BallMotion motion = ball;
  double time = 0.0;
  add(time, motion);
  for (int i = 0; i < kMaximumSteps && isFlying(motion); ++i) {
    const double fall = motion.v_FB.z();
    stepBall(motion, kCycleTime);
    time += kCycleTime;
    const bool bounced = fall < 0.0 && motion.v_FB.z() >= 0.0;
    if (bounced && count_ + 1 < kMostLegs) add(time, motion);
  }
  // A last hop lower than a flying ball ends without a bounce.
  if (legs_[count_ - 1].decay != kRollDecay) add(time, motion);
}

void FreeBall::add(double begin, const BallMotion& ball) {
  legs_[count_++] = {begin, ball.p_FB.head<2>(), ball.v_FB.head<2>(),
                     isFlying(ball) ? kAirDecay : kRollDecay};
}

Vector2 FreeBall::at(double seconds) const {
  std::size_t i = count_ - 1;
  while (i > 0 && legs_[i].begin > seconds) --i;
  const Leg& leg = legs_[i];
  return leg.p_FB + (1.0 - std::exp(-leg.decay * (seconds - leg.begin))) / leg.decay * leg.v_FB;
}

double FreeBall::slowAfter(double speed) const {
  const Leg& roll = legs_[count_ - 1];
  return roll.begin + std::max(0.0, std::log(roll.v_FB.norm() / speed) / roll.decay);
}

double FreeBall::goneAfter(double distance) const {
  double gone = 0.0;
  for (std::size_t i = 0; i < count_; ++i) {
    const Leg& leg = legs_[i];
    const bool last = i + 1 == count_;
    const double length = last ? leg.v_FB.norm() / leg.decay : (legs_[i + 1].p_FB - leg.p_FB).norm();
    if (distance < gone + length)
      return leg.begin - std::log(1.0 - leg.decay * (distance - gone) / leg.v_FB.norm()) / leg.decay;
    gone += length;
  }
  return std::numeric_limits<double>::infinity();
}

Vector2 restPlace(const BallMotion& ball) {
  return FreeBall(ball).at(std::numeric_limits<double>::infinity());
}

std::optional<LineCrossing> crossingOfLine(const BallMotion& ball, double x) {
  const double side = x - ball.p_FB.x();
  BallMotion motion = ball;
  double time = 0.0;
  for (int i = 0; i < kMaximumSteps && isFlying(motion); ++i) {
    const BallMotion before = motion;
    stepBall(motion, kCycleTime);
    const double left = x - motion.p_FB.x();
    if (left * side <= 0.0) {
      const double length = motion.p_FB.x() - before.p_FB.x();
      const double share = length != 0.0 ? (x - before.p_FB.x()) / length : 0.0;
      const Vector3 p = before.p_FB + share * (motion.p_FB - before.p_FB);
      return LineCrossing{time + share * kCycleTime, p.y(), p.z()};
    }
    time += kCycleTime;
  }
  // Rolling: x(t) = x0 + v (1 - exp(-k t)) / k.
  const double need = (x - motion.p_FB.x()) * kRollDecay;
  const double speed = motion.v_FB.x();
  if (speed == 0.0 || need / speed < 0.0 || need / speed >= 1.0) return std::nullopt;
  const double share = need / speed;
  return LineCrossing{time - std::log(1.0 - share) / kRollDecay,
                      motion.p_FB.y() + share * motion.v_FB.y() / kRollDecay, motion.p_FB.z()};
}

}  // namespace nonet::world
