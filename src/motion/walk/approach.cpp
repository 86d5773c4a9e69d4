#include "nonet/motion/walk/approach.h"

#include <algorithm>
#include <cmath>

namespace nonet::motion {

namespace {

// From here on the robot faces the target; from half of it, it takes the target's heading.
constexpr double kFacingDistance = 0.5;  // m

}  // namespace

// Walks and turns at the same time, always [MacAlpine 2012a, section 4.2]: straight at the target as fast as
// the set allows in that direction, turning towards it when far, to the target's heading when near.
Pose2 speedTowards(const ApproachParameters& p, const GaitParameters& gait, const Pose2& X_WTarget, bool stop,
                   bool turnAtOnce) {
  const Vector2& target = X_WTarget.translation;
  const double distance = target.norm();
  const double bearing = distance > 1e-6 ? std::atan2(target.y(), target.x()) : 0.0;
  const double far = turnAtOnce ? 0.0 : std::clamp(2.0 * distance / kFacingDistance - 1.0, 0.0, 1.0);
  const double angle = wrapAngle(X_WTarget.rotation + far * wrapAngle(bearing - X_WTarget.rotation));

  const double duration = Gait::stepDuration(gait);
  Pose2 speed;
  speed.rotation =
      std::clamp(p.turnGain * angle, -gait.maxStepTheta / duration, gait.maxStepTheta / duration);
  if (distance < 1e-6) return speed;
  const Vector2 direction = target / distance;
  const double maxX = direction.x() >= 0.0 ? gait.maxStepX : gait.maxStepXBack;
  const double share =
      std::hypot(direction.x() / std::max(maxX, 1e-6), direction.y() / std::max(gait.maxStepY, 1e-6));
  double most = 1.0 / (share * duration);
  if (stop) most = std::min(most, p.speedGain * distance);
  speed.translation = most * direction;
  return speed;
}

}  // namespace nonet::motion
