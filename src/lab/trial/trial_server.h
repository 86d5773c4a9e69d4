// The server of a trial that puts robots and ball where it wants them, and begins play itself.
#pragma once

#include "nonet/sim/settings/settings.h"

namespace nonet::lab {

/// `preparation`: seconds that the trial needs before play.
inline sim::Settings trialServer(sim::Settings settings, double preparation) {
  settings.beamNoiseXY = 0.0;
  settings.beamNoiseAngle = 0.0;
  settings.startAnyFieldPosition = true;
  settings.automaticKickOff = false;
  settings.waitBeforeKickOff = 2.0 * preparation;
  return settings;
}

}  // namespace nonet::lab
