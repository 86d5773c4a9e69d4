#include "nonet/lab/trial/push.h"

#include <cmath>

#include "nonet/math/angle.h"
#include "nonet/math/direction.h"
#include "nonet/model/robot_model.h"

namespace nonet::lab {

void pushRobot(sim::World& world, sim::RobotHandle robot, double most, Random& random) {
  const Vector2 direction = unitVector(random.uniform(-kPi, kPi));
  const Vector2 change = most * std::sqrt(random.uniform()) * direction;
  for (const model::BodySpec& body : model::robotModel(world.robotType(robot)).bodies()) {
    auto state = world.bodyState(robot, body.id);
    state.velocity.head<2>() += change;
    world.setBodyState(robot, body.id, state);
  }
}

}  // namespace nonet::lab
