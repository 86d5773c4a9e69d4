#include "nonet/world/ball_tracker.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "nonet/math/angle.h"
#include "nonet/world/vision_frame.h"

namespace nonet::world {

namespace {

constexpr double kPositionNoise = 0.002;  // m per cycle
constexpr double kRestNoise = 0.02;       // m/s per root second, of the velocity
constexpr double kRollNoise = 0.1;        // m/s per root second per m/s
constexpr double kKickSpeed = 6.0;        // m/s, sigma of what a kick adds
constexpr double kKickLift = 4.0;         // m/s, of that upwards
constexpr double kKickGate = 14.0;        // squared sigmas
constexpr double kRestartGate = 30.0;
constexpr double kUnseenGrowth = 0.3;  // m/s
constexpr double kHeldSigma = 0.01;    // m, of where the referee holds it
constexpr double kPutSigma = 0.2;      // m, of where it crossed the touch line
constexpr double kGrace = 0.3;         // s without a sighting before the growth begins
constexpr double kBounced = 0.9;     // share of the speed that no flight takes in a cycle, but a bounce does
constexpr double kKickGone = 0.5;    // s since when it may have been kicked, at most
constexpr double kFits = 2.0;        // squared sigmas of a sighting that shows no kick
constexpr double kKnownSigma = 1.2;  // m
constexpr double kKnownAge = 8.0;    // s

}  // namespace

BallMotion BallTracker::motion() const {
  return {{state_(0), state_(1), height_}, {state_(2), state_(3), lift_}};
}

void BallTracker::setMotion(const BallMotion& motion) {
  state_ << motion.p_FB.head<2>(), motion.v_FB.head<2>();
  height_ = motion.p_FB.z();
  lift_ = motion.v_FB.z();
}

void BallTracker::predict(double dt) {
  if (!started_) return;
  BallMotion ball = motion();
  const bool flying = isFlying(ball);
  const bool surelyFalls = -lift_ > 2.0 * std::sqrt(heightCovariance_(1, 1));
  const Vector2 before = ball.v_FB.head<2>();
  moveBall(ball, dt);
  // A bounce costs speed, but the noise of the height must not make one.
  if (flying && !surelyFalls && ball.v_FB.head<2>().norm() < kBounced * before.norm())
    ball.v_FB.head<2>() = std::exp(-kAirDecay * dt) * before;
  const double speed = ball.v_FB.head<2>().norm();
  setMotion(ball);
  const double decay = flying ? kAirDecay : kRollDecay;
  StateMatrix F = StateMatrix::Identity();
  F(0, 2) = F(1, 3) = dt;
  F(2, 2) = F(3, 3) = std::exp(-decay * dt);
  covariance_ = F * covariance_ * F.transpose();
  const double speedNoise = kRestNoise + kRollNoise * speed;
  for (int i = 0; i < 2; ++i) {
    covariance_(i, i) += kPositionNoise * kPositionNoise * dt / kCycleTime;
    covariance_(i + 2, i + 2) += speedNoise * speedNoise * dt;
  }
  Matrix2 G;
  G << 1.0, dt, 0.0, 1.0;
  heightCovariance_ = G * heightCovariance_ * G.transpose();
  heightCovariance_(0, 0) += 1e-5;
  heightCovariance_(1, 1) += flying ? 0.01 : 1e-3;
  sinceSeen_ += dt;
  if (sinceSeen_ > kGrace) {
    for (int i = 0; i < 2; ++i) {
      const double sigma = std::sqrt(covariance_(i, i)) + kUnseenGrowth * dt;
      covariance_(i, i) = sigma * sigma;
    }
  }
}

void BallTracker::start(const Vector3& p_FB, const Matrix2& covariance) {
  started_ = true;
  state_ << p_FB.head<2>(), 0.0, 0.0;
  covariance_.setZero();
  covariance_.topLeftCorner<2, 2>() = covariance;
  covariance_.bottomRightCorner<2, 2>() = Matrix2::Identity() * kKickSpeed * kKickSpeed;
  height_ = p_FB.z();
  lift_ = 0.0;
  heightCovariance_ << 0.01, 0.0, 0.0, 1.0;
}

void BallTracker::see(const protocol::Vision& vision, const SelfState& self, const Vector3& offset,
                      double time) {
  if (!vision.ball || !vision.ball->isFinite()) {
    if (!started_) return;
    const Vector3 p_CB = self.X_FC.inverse() * Vector3(state_(0), state_(1), height_);
    absences_ = self.localized && clearlyInView(p_CB, 0.0) ? absences_ + 1 : 0;
    if (absences_ < kAbsencesToForget) return;
    started_ = false;
    missedAt_ = time;
    return;
  }
  absences_ = 0;
  const ObservedPoint seen(*vision.ball);
  const Vector3 p_FB = self.X_FC * (seen.p_CP - offset);
  // Noise of the sighting, and of the own pose: position, and heading across the line of sight.
  const Matrix3 unwhiten = self.X_FC.linear() * seen.whitener.inverse();
  Matrix3 covariance = unwhiten * unwhiten.transpose();
  const Vector2 arm = p_FB.head<2>() - self.X_FC.translation().head<2>();
  const Vector2 across(-arm.y(), arm.x());
  covariance.topLeftCorner<2, 2>() +=
      self.cameraCovariance.topLeftCorner<2, 2>() + self.cameraCovariance(2, 2) * across * across.transpose();
  covariance(2, 2) += 1e-4;
  measure(p_FB, covariance, time);
  lastSeen_ = time;
  sinceSeen_ = 0.0;
}

double BallTracker::mismatch(const Vector2& measured, const Matrix2& covariance) const {
  const Vector2 innovation = measured - state_.head<2>();
  const Matrix2 expected = covariance_.topLeftCorner<2, 2>() + covariance;
  return innovation.dot(expected.inverse() * innovation);
}

double BallTracker::kalman(const Vector2& measured, const Matrix2& covariance) {
  const Vector2 innovation = measured - state_.head<2>();
  const Matrix2 expected = covariance_.topLeftCorner<2, 2>() + covariance;
  const Matrix2 inverse = expected.inverse();
  const Eigen::Matrix<double, 4, 2> gain = covariance_.leftCols<2>() * inverse;
  state_ += gain * innovation;
  covariance_ -= gain * covariance_.topRows<2>();
  covariance_ = (0.5 * (covariance_ + covariance_.transpose())).eval();
  return innovation.dot(inverse * innovation);
}

void BallTracker::measureHeight(double z, double variance) {
  const double expected = heightCovariance_(0, 0) + variance;
  const Vector2 gain = heightCovariance_.col(0) / expected;
  const double innovation = z - height_;
  height_ += gain.x() * innovation;
  lift_ += gain.y() * innovation;
  heightCovariance_ -= gain * heightCovariance_.row(0);
  if (innovation * innovation > 9.0 * expected) heightCovariance_(1, 1) += 1.0;
  height_ = std::max(height_, 0.0);
}

// A kick at some moment of the last `within` seconds, any as likely as another, has added a velocity v; at
// time t after it the ball is v t away. The first two moments of both: E[t] = within / 2, E[t^2] = within^2
// / 3. So one sighting tells the direction, and the speed roughly.
void BallTracker::kicked(double within) {
  const double speed = kKickSpeed * kKickSpeed;
  covariance_.bottomRightCorner<2, 2>() += Matrix2::Identity() * speed;
  covariance_.topLeftCorner<2, 2>() += Matrix2::Identity() * speed * within * within / 3.0;
  covariance_.topRightCorner<2, 2>() = covariance_.bottomLeftCorner<2, 2>() =
      Matrix2::Identity() * speed * within / 2.0;
  const double lift = kKickLift * kKickLift;
  heightCovariance_(1, 1) += lift;
  heightCovariance_(0, 0) += lift * within * within / 3.0;
  heightCovariance_(0, 1) = heightCovariance_(1, 0) = lift * within / 2.0;
}

void BallTracker::measure(const Vector3& p_FB, const Matrix3& covariance, double time) {
  const Matrix2 plane = covariance.topLeftCorner<2, 2>();
  if (!started_) {
    start(p_FB, plane);
    lastFit_ = time;
    return;
  }
  const Vector2 measured = p_FB.head<2>();
  const double misfit = mismatch(measured, plane);
  const double unkicked = lastFit_;
  const bool kick = misfit > kKickGate;
  if (kick || misfit <= kFits) lastFit_ = time;
  if (kick) {
    // Somebody has kicked it, or put it somewhere else; a soft kick shows after some sightings only.
    lastKick_ = time;
    kicked(std::clamp(time - unkicked, kCycleTime, kKickGone));
    if (mismatch(measured, plane) > kRestartGate) {
      start(p_FB, plane);
      return;
    }
  }
  kalman(measured, plane);
  measureHeight(p_FB.z(), covariance(2, 2));
}

// Where a ball that a mate told of `age` ago is now: it flies, then it rolls. How high nobody tells: as high
// as a ball that has left the ground just now and is up for so long.
BallMotion BallTracker::reported(const Report& report, double age) {
  BallMotion ball{{report.p_FB.x(), report.p_FB.y(), kBallRestHeight},
                  {report.v_FB.x(), report.v_FB.y(), 0.5 * kGravity * report.landsIn}};
  moveBall(ball, age);
  return ball;
}

void BallTracker::hear(const Report& report, double time) {
  // Only what is clearly newer than the own sight helps, and none from before it was missed there.
  if (!started_ && report.seenAt < missedAt_) return;
  if (report.seenAt < lastSeen_ + kGrace || report.seenAt < lastReported_) return;
  const double age = std::max(0.0, time - report.seenAt);
  const BallMotion ball = reported(report, std::max(0.0, time - report.toldAt));
  const double sigma = report.sigma + kUnseenGrowth * age;
  const Matrix2 covariance = Matrix2::Identity() * sigma * sigma;
  lastReported_ = report.seenAt;
  absences_ = 0;
  const bool worse = !started_ || covariance_.topLeftCorner<2, 2>().trace() > covariance.trace();
  if (worse || mismatch(ball.p_FB.head<2>(), covariance) > kKickGate) {
    start(ball.p_FB, covariance);
    lastFit_ = time;
    state_.tail<2>() = ball.v_FB.head<2>();
    lift_ = ball.v_FB.z();
    covariance_.bottomRightCorner<2, 2>() = Matrix2::Identity() * 0.25;
  } else {
    kalman(ball.p_FB.head<2>(), covariance);
  }
}

void BallTracker::rest(const Vector2& p_FB, double sigma, double time) {
  start({p_FB.x(), p_FB.y(), kBallRestHeight}, Matrix2::Identity() * sigma * sigma);
  covariance_.bottomRightCorner<2, 2>() = Matrix2::Identity() * 1e-2;
  lastReported_ = lastFit_ = time;
}

void BallTracker::hold(const Vector2& p_FB, double time) {
  if (started_ && time - lastSeen_ < kGrace) return;
  rest(p_FB, kHeldSigma, time);
}

void BallTracker::put(const Vector2& p_FB, double time) {
  rest(p_FB, kPutSigma, time);
  sinceSeen_ = 0.0;
  absences_ = 0;
}

void BallTracker::mirror() {
  state_ *= -1.0;
}

void BallTracker::fill(BallState& state, const SelfState& self, double time) const {
  const BallMotion ball = motion();
  state.p_FB = ball.p_FB;
  state.v_FB = ball.v_FB;
  state.p_RB = self.X_FR.inverse() * Vector2(ball.p_FB.head<2>());
  state.covariance = covariance_.topLeftCorner<2, 2>();
  state.lastSeen = lastSeen_;
  state.lastReported = lastReported_;
  state.lastKick = lastKick_;
  const double sigma = std::sqrt(std::max(covariance_(0, 0), covariance_(1, 1)));
  state.known = started_ && sigma < kKnownSigma && time - std::max(lastSeen_, lastReported_) < kKnownAge;
}

}  // namespace nonet::world
