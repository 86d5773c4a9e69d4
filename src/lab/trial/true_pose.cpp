#include "nonet/lab/trial/true_pose.h"

#include <algorithm>
#include <cmath>

namespace nonet::lab {

namespace {

const sim::ScenePose& torsoOf(const sim::World& world, sim::RobotHandle robot) {
  return world.bodyPose(robot, model::BodyId::Torso);
}

}  // namespace

Pose2 truePose(const sim::World& world, sim::RobotHandle robot) {
  const sim::ScenePose& torso = torsoOf(world, robot);
  const sim::Vector3f forward = torso.rotation.col(1);  // the server's bodies look along y
  return {torso.position.x(), torso.position.y(), std::atan2(forward.y(), forward.x())};
}

double trueTilt(const sim::World& world, sim::RobotHandle robot) {
  const double up = torsoOf(world, robot).rotation(2, 2);
  return std::acos(std::clamp(up, -1.0, 1.0));
}

bool isDown(const sim::World& world, sim::RobotHandle robot) {
  return isDown(torsoOf(world, robot).position.cast<double>().z(), model::robotModel(world.robotType(robot)));
}

bool isDown(double torsoHeight, const model::RobotModel& model) {
  return torsoHeight < 0.55 * model.standingHeight();
}

}  // namespace nonet::lab
