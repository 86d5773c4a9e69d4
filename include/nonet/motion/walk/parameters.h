// Declared parameters of the walk, a group for each layer: one object is one parameter set.
//
// Sentences end with the name that a parameter has in [MacAlpine 2012b, table 1], if it has one there. Ranges
// bound only what breaks the code: learned optima lie outside what a physical reading would allow.
#pragma once

#include "nonet/motion/walk/approach.h"
#include "nonet/motion/walk/balance.h"
#include "nonet/motion/walk/gait.h"
#include "nonet/motion/walk/pendulum.h"
#include "nonet/motion/walk/posture.h"
#include "nonet/motion/walk/recovery.h"

namespace nonet::motion {

struct WalkParameters {
  GaitParameters gait;
  PendulumParameters pendulum;
  WalkPostureParameters posture;
  BalanceParameters balance;
  RecoveryParameters recovery;
  ApproachParameters approach;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    visit.group("gait", self.gait);
    visit.group("pendulum", self.pendulum);
    visit.group("posture", self.posture);
    visit.group("balance", self.balance);
    visit.group("recovery", self.recovery);
    visit.group("approach", self.approach);
  }
};

/// The set between two others: share 0 gives `from`, 1 gives `to`.
WalkParameters blend(const WalkParameters& from, const WalkParameters& to, double share);

}  // namespace nonet::motion
