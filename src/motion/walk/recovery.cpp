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

Attitude levelled(const RecoveryParameters& p, const Attitude& lean, const Tilt& tilt) {
  return {.pitch = lean.pitch + p.levelGain * beyond(tilt.pitch, p.farTilt),
          .roll = lean.roll + p.levelGain * beyond(tilt.roll, p.farTilt)};
}

Vector2 landingShift(const RecoveryParameters& p, const Tilt& tilt) {
  return {p.stepGain * beyond(tilt.pitch, p.farTilt), -p.stepGain * beyond(tilt.roll, p.farTilt)};
}

}  // namespace nonet::motion
