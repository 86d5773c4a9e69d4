// Fifth layer of the walk: what brings a robot back from a far tilt.
//
// A body that tilts with level feet commanded stands on their edges, and on the low side the swing foot never
// clears the ground: small gains that suit a walk keep a robot stepping at that tilt until it falls. So
// beyond a limit other gains act, on what the tilt is beyond it.
//
// Needs: the tilt. Gives: legs turned against the torso, a shifted landing of the swing foot.
#pragma once

#include "nonet/config/parameters.h"
#include "nonet/motion/walk/measurement.h"

namespace nonet::motion {

struct RecoveryParameters {
  double farTilt = 0.2;
  double levelGain = 0.0;
  double stepGain = 0.0;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    using namespace config;
    visit({"farTilt",
           Unit::Radian,
           {0.0, 3.2},
           search(0.1, 0.35),
           "Tilt beyond which the gains for recovering act, on what is beyond it"},
          self.farTilt);
    visit({"levelGain",
           Unit::None,
           {-3.0, 3.0},
           search(0.0, 1.0),
           "How far the legs turn against the torso in rad per rad of tilt beyond farTilt: with 1 they stay "
           "upright"},
          self.levelGain);
    visit({"stepGain",
           Unit::Metre,
           {-2.0, 2.0},
           search(0.0, 0.3),
           "How far the swing foot lands to the side of the fall in m per rad of tilt beyond farTilt"},
          self.stepGain);
  }
};

/// Whether recovery acts.
bool stumbles(const RecoveryParameters& parameters, const Tilt& tilt);
/// The lean to command instead of `lean`.
Attitude levelled(const RecoveryParameters& parameters, const Attitude& lean, const Tilt& tilt);
/// Shift of the swing foot's landing, m, forward and to the left.
Vector2 landingShift(const RecoveryParameters& parameters, const Tilt& tilt);

}  // namespace nonet::motion
