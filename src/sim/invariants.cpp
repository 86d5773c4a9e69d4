#include "nonet/sim/invariants.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "nonet/math/angle.h"
#include "nonet/model/robot_model.h"

namespace nonet::sim {

void Invariants::violate(const std::string& what) {
  constexpr std::size_t kMessagesKept = 20;
  ++violations_;
  if (messages_.size() < kMessagesKept) messages_.push_back(fmt::format("{:.2f} s: {}", time_, what));
}

void Invariants::checkBody(const World::BodyState& state, RobotHandle robot, model::BodyId body) {
  const auto name = [robot, body] {
    if (robot == kNoRobot) return std::string("the ball");
    return fmt::format("body {} of robot {}", static_cast<int>(body), robot);
  };
  if (!state.position.allFinite() || !state.orientation.coeffs().allFinite() || !state.velocity.allFinite() ||
      !state.angularVelocity.allFinite()) {
    violate(name() + " is not finite");
    return;
  }
  const double height = state.position.z();
  const double speed = state.velocity.norm();
  extremes_.lowestCentre = std::min(extremes_.lowestCentre, height);
  extremes_.fastestBody = std::max(extremes_.fastestBody, speed);
  if (height < limits_.lowestCentre || height > limits_.highestCentre) {
    violate(fmt::format("{} is {:.3f} m above the ground", name(), height));
  }
  if (speed > limits_.fastestBody) violate(fmt::format("{} moves with {:.1f} m/s", name(), speed));
}

void Invariants::checkRobot(const World& world, RobotHandle robot) {
  const model::RobotModel& model = model::robotModel(world.robotType(robot));
  for (const model::BodySpec& body : model.bodies()) {
    checkBody(world.bodyState(robot, body.id), robot, body.id);
  }
  for (const model::JointSpec& joint : model.joints()) {
    const double angle = toRadians(world.jointAngleDegrees(robot, joint.id));
    const double beyond = std::max(joint.low - angle, angle - joint.high);
    extremes_.overshoot = std::max(extremes_.overshoot, beyond);
    const bool toe = joint.id == model::JointId::RLeg7 || joint.id == model::JointId::LLeg7;
    const double most = toe ? limits_.toeOvershoot : limits_.overshoot;
    if (beyond <= most + limits_.overshootMargin) continue;  // false for a NaN too
    violate(fmt::format("{} of robot {} is at {:.2f} deg, {:.2f} deg beyond its stop",
                        model::perceptorName(joint.id), robot, toDegrees(angle), toDegrees(beyond)));
  }
}

void Invariants::check(const Simulation& simulation) {
  time_ = simulation.match().serverTime;
  const World& world = simulation.world();
  const Vector3f ball = world.ballPosition();
  const Vector3f velocity = world.ballVelocity();
  World::BodyState state;
  state.position = ball.cast<double>();
  state.velocity = velocity.cast<double>();
  state.orientation.setIdentity();
  state.angularVelocity = world.ballAngularVelocity().cast<double>();
  checkBody(state, kNoRobot, model::BodyId::Torso);
  for (const RobotHandle robot : world.robots()) checkRobot(world, robot);
}

}  // namespace nonet::sim
