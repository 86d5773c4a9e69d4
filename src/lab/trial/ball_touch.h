// Who touches the ball, by the simulation's contacts.
#pragma once

#include "nonet/sim/physics/world.h"

namespace nonet::lab {

/// Who touched the ball in the last step.
struct BallTouches {
  bool robot = false;  // the one that was asked about
  bool other = false;  // any other robot
};
BallTouches ballTouches(const sim::World& world, sim::RobotHandle robot);

}  // namespace nonet::lab
