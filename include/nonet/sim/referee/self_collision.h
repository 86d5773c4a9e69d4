// Limbs of one robot that overlap, as the referee sees them (server facts 4.10): it freezes their joints for
// a second. The physics lets them pass through each other.
#pragma once

#include <functional>

#include "nonet/model/robot_model.h"
#include "nonet/sim/physics/world.h"

namespace nonet::sim {

/// Calls `found` for each pair of boxes that overlap by more than `tolerance`, m.
void findSelfCollisions(const World& world, RobotHandle robot, float tolerance,
                        const std::function<void(model::BodyId, model::BodyId)>& found);

/// Whether there is such a pair, with the server's own tolerance.
bool selfCollides(const World& world, RobotHandle robot);

}  // namespace nonet::sim
