#include "nonet/motion/walk/pendulum.h"

#include <cmath>

namespace nonet::motion {

// Sideways the distance to the stance foot is d cosh(k tau) / cosh(k T/2) with d that at the change of feet.
// Forward it is d sinh(k tau) / sinh(k T/2) with d half a step, of which the walk frame already makes the
// steady part.
Vector2 pendulumOffset(const PendulumParameters& p, const GaitState& gait, double footSeparation) {
  if (gait.standing) return Vector2::Zero();
  const double halfTime = 0.5 * gait.stepDuration;
  const double k = std::sqrt(kGravity / p.height);
  const double tau = (2.0 * gait.phase - 1.0) * halfTime;
  const double halfSeparation = 0.5 * footSeparation;
  const double natural = halfSeparation * (1.0 - std::cosh(k * tau) / std::cosh(k * halfTime));
  const double full = halfSeparation * (1.0 - 1.0 / std::cosh(k * halfTime));
  const double y = p.swayFactor * natural + p.yShift * natural / full;
  const double x = 0.5 * gait.step.translation.x() * p.surgeFactor *
                   (std::sinh(k * tau) / std::sinh(k * halfTime) - tau / halfTime);
  return {x, sideSign(gait.stance) * y};
}

Vector3 soleBelowTorso(const PendulumParameters& p, const GaitState& gait, const Vector2& p_TS,
                       const Vector3& p_TCom, double standingHeight) {
  const Vector2& step = gait.step.translation;
  const double ahead = step.x() >= 0.0 ? p.aheadPerStep : p.aheadPerStepBack;
  // A pendulum of height h that accelerates by a leans h a / g ahead of its foot.
  const Vector2 shift = p.height / kGravity * gait.acceleration;
  Vector3 sole;
  sole.x() = p_TS.x() + p.feetAhead - ahead * step.x() + p.comCompensationX * p_TCom.x() -
             p.accelerationShiftX * shift.x();
  sole.y() = p_TS.y() - p.asidePerStep * step.y() + p.comCompensationY * p_TCom.y() -
             p.accelerationShiftY * shift.y();
  sole.z() = -p.torsoHeight * standingHeight;
  return sole;
}

}  // namespace nonet::motion
