// Targets that jump about: their mean over some time. A target that jumps once, or moves steadily, is
// followed at once.
#pragma once

#include "nonet/math/pose2.h"

namespace nonet::motion {

class TargetFilter {
 public:
  /// Target and result as the robot sees them; `step` is what the robot has moved since the last cycle, of
  /// which times are `cycleTime` apart. `smoothing` is the time constant in s for a restless target; 0
  /// gives the target itself.
  Pose2 update(const Pose2& target, const Pose2& step, double cycleTime, double smoothing);

  void reset() { begun_ = false; }

 private:
  bool begun_ = false;
  Pose2 last_;
  Pose2 mean_;
  double jumps_ = 0.0;  // of late, each forgotten by and by
};

}  // namespace nonet::motion
