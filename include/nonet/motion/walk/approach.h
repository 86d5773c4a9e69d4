// The speed that leads to a target, for walks that go to one.
//
// Needs: the target, what the walk can do (GaitParameters). Gives: the speed to ask the gait for.
#pragma once

#include "nonet/motion/walk/gait.h"

namespace nonet::motion {

struct ApproachParameters {
  double speedGain = 3.0;
  double turnGain = 4.0;
  double smoothing = 0.0;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    using namespace config;
    visit({"speedGain",
           Unit::Hertz,
           {0.1, 50.0},
           search(1.0, 10.0),
           "Speed near a target to stop at, in m/s per m of distance"},
          self.speedGain);
    visit({"turnGain",
           Unit::Hertz,
           {0.1, 50.0},
           search(1.0, 10.0),
           "Turning speed in rad/s per rad of angle to the wanted heading"},
          self.turnGain);
    visit({"smoothing",
           Unit::Second,
           {0.0, 5.0},
           search(0.0, 1.0),
           "Time over which the place of a target that jumps about is averaged"},
          self.smoothing);
  }
};

/// m/s, m/s, rad/s in the walk frame, in which the target is given. `stop`: slow down near the target;
/// `turnAtOnce`: take the target's heading however far it is.
Pose2 speedTowards(const ApproachParameters& parameters, const GaitParameters& gait, const Pose2& X_WTarget,
                   bool stop, bool turnAtOnce = false);

}  // namespace nonet::motion
