// Somebody bumps into a robot.
#pragma once

#include "nonet/math/random.h"
#include "nonet/sim/physics/world.h"

namespace nonet::lab {

/// All bodies of the robot are faster by the same velocity, of up to `most` m/s in any direction.
void pushRobot(sim::World& world, sim::RobotHandle robot, double most, Random& random);

}  // namespace nonet::lab
