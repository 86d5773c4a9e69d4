#include "nonet/motion/walk/recovery.h"

#include <algorithm>

namespace nonet::motion {

namespace {

double beyond(double tilt, double limit) {
  return tilt - std::clamp(tilt, -limit, limit);
}

}  // namespace

bool stumbles(const RecoveryParameters& p, const Tilt& tilt) {
  return tilt.largest() > p.farTilt;
}

Push pushOf(const RecoveryParameters& p, const Tilt& tilt, const Vector2& moves) {
  const auto pushed = [&](double lean, double speed) { return lean > p.pushedTilt && speed > p.pushedSpeed; };
  Push push;
  if (pushed(-tilt.pitch, -moves.x())) push.forward = moves.x();
  if (pushed(-tilt.roll, moves.y()) || pushed(tilt.roll, -moves.y())) push.left = moves.y();
  return push;
}

Attitude levelled(const RecoveryParameters& p, const Attitude& lean, const Tilt& tilt) {
  return {.pitch = lean.pitch + p.levelGain * beyond(tilt.pitch, p.farTilt),
          .roll = lean.roll + p.levelGain * beyond(tilt.roll, p.farTilt)};
}

Vector2 landingShift(const RecoveryParameters& p, const Tilt& tilt) {
  return {p.stepGain * beyond(tilt.pitch, p.farTilt), -p.stepGain * beyond(tilt.roll, p.farTilt)};
}

}  // namespace nonet::motion
