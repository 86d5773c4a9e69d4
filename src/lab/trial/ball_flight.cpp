#include "lab/trial/ball_flight.h"

#include <algorithm>

namespace nonet::lab {

namespace {

constexpr double kAMetre = 1.0;  // m
constexpr double kFlies = 0.15;  // m: higher than it is thrown by what it rolls over
constexpr double kDown = 0.06;   // m

}  // namespace

void BallFlight::note(const world::BallMotion& ball) {
  ball_ = ball;
  const double height = ball.p_FB.z();
  const double way = (ball.p_FB.head<2>() - p_FBegin_).norm();
  if (height_ == 0.0 && way > kAMetre) height_ = height;
  if (landing_ == 0.0) highest_ = std::max(highest_, height);
  flew_ = flew_ || height > kFlies;
  if (flew_ && landing_ == 0.0 && height < kDown) landing_ = way;
}

void BallFlight::tell(Kick& kick) const {
  kick.height = height_;
  kick.highest = highest_;
  kick.landing = landing_;
  if (!flew_ || landing_ > 0.0) return;
  const Vector2 end = ball_.p_FB.head<2>() + world::landingTime(ball_) * ball_.v_FB.head<2>();
  kick.landing = (end - p_FBegin_).norm();
}

}  // namespace nonet::lab
