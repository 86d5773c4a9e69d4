#include "nonet/motion/target_filter.h"

#include <algorithm>
#include <cmath>

#include "nonet/math/angle.h"

namespace nonet::motion {

namespace {

constexpr double kJump = 0.1;         // m in one cycle: 5 m/s
constexpr double kRemembered = 0.5;   // s, a jump
constexpr double kRestless = 1.2;     // jumps remembered: one in less than 0.9 s
constexpr double kOtherTarget = 1.5;  // m; what jumps farther is not the same target

}  // namespace

Pose2 TargetFilter::update(const Pose2& target, const Pose2& step, double cycleTime, double smoothing) {
  const Pose2 back = step.inverse();
  last_ = back * last_;
  mean_ = back * mean_;
  const double jump = (target.translation - last_.translation).norm();
  jumps_ = jumps_ * std::exp(-cycleTime / kRemembered) + (jump > kJump ? 1.0 : 0.0);
  last_ = target;
  const double time = smoothing * std::clamp(jumps_ - kRestless, 0.0, 1.0);
  const Vector2 gap = target.translation - mean_.translation;
  if (!begun_ || time < cycleTime || gap.norm() > kOtherTarget) {
    if (!begun_) jumps_ = 0.0;
    begun_ = true;
    mean_ = target;
    return target;
  }
  const double share = cycleTime / (time + cycleTime);
  mean_.translation += share * gap;
  mean_.rotation = wrapAngle(mean_.rotation + share * wrapAngle(target.rotation - mean_.rotation));
  return mean_;
}

}  // namespace nonet::motion
