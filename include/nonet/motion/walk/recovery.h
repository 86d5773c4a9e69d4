// Fifth layer of the walk: what brings a robot back from a far tilt or a push.
//
// A body that tilts with level feet commanded stands on their edges, where the lower swing foot drags: small
// gains that suit a walk keep it stepping so until it falls. Beyond a limit others act, on what is beyond it.
// Who is pushed back or aside falls unless the feet come along at once: then the step takes the body's speed.
//
// Needs: tilt, speed. Gives: legs turned against the torso, a shifted landing of the swing foot, the step.
#pragma once

#include "nonet/config/parameters.h"
#include "nonet/motion/walk/measurement.h"

namespace nonet::motion {

struct RecoveryParameters {
  double farTilt = 0.2;
  double levelGain = 0.0;
  double stepGain = 0.0;
  double pushedTilt = 0.12;
  double pushedSpeed = 0.15;

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
    visit({"pushedTilt",
           Unit::Radian,
           {0.0, 3.2},
           search(0.0, 0.3),
           "Leaning back or aside by more than this the robot may be pushed"},
          self.pushedTilt);
    visit({"pushedSpeed",
           Unit::MetrePerSecond,
           {0.0, 10.0},
           search(0.05, 0.4),
           "It is pushed if it moves there faster than this: then it steps at least as fast at once"},
          self.pushedSpeed);
  }
};

/// Whether recovery acts.
bool stumbles(const RecoveryParameters& parameters, const Tilt& tilt);
/// What pushes the body while it moves like this, m/s, forward and to the left.
Push pushOf(const RecoveryParameters& parameters, const Tilt& tilt, const Vector2& moves);
/// The lean to command instead of `lean`.
Attitude levelled(const RecoveryParameters& parameters, const Attitude& lean, const Tilt& tilt);
/// Shift of the swing foot's landing, m, forward and to the left.
Vector2 landingShift(const RecoveryParameters& parameters, const Tilt& tilt);

}  // namespace nonet::motion
