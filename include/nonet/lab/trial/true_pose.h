// Where a simulated robot truly is. World axes, m and rad.
#pragma once

#include "nonet/math/pose2.h"
#include "nonet/model/robot_model.h"
#include "nonet/sim/physics/world.h"

namespace nonet::lab {

/// Torso on the ground, heading.
Pose2 truePose(const sim::World& world, sim::RobotHandle robot);

/// Between torso and upright, rad.
double trueTilt(const sim::World& world, sim::RobotHandle robot);

/// Torso below 0.55 of the standing height: it lies or kneels.
bool isDown(const sim::World& world, sim::RobotHandle robot);
/// The same of a robot whose torso is at this height, m.
bool isDown(double torsoHeight, const model::RobotModel& model);

}  // namespace nonet::lab
