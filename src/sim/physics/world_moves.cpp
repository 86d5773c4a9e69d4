// Everything that changes poses and velocities from outside the physics.
#include <cmath>

#include <Eigen/Geometry>

#include "sim/physics/scene.h"
#include "sim/physics/world_implementation.h"

namespace nonet::sim {

namespace {

void stop(dBodyID body) {
  dBodySetLinearVel(body, 0.0, 0.0, 0.0);
  dBodySetAngularVel(body, 0.0, 0.0, 0.0);
}

World::BodyState stateOf(dBodyID body) {
  World::BodyState state;
  const dReal* q = dBodyGetQuaternion(body);
  state.position = Eigen::Map<const Eigen::Vector3d>(dBodyGetPosition(body));
  state.orientation = Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
  state.velocity = Eigen::Map<const Eigen::Vector3d>(dBodyGetLinearVel(body));
  state.angularVelocity = Eigen::Map<const Eigen::Vector3d>(dBodyGetAngularVel(body));
  return state;
}

void setState(BodyNode& node, const World::BodyState& state) {
  const Eigen::Vector3d& p = state.position;
  const Eigen::Vector3d& v = state.velocity;
  const Eigen::Vector3d& w = state.angularVelocity;
  const dQuaternion q = {state.orientation.w(), state.orientation.x(), state.orientation.y(),
                         state.orientation.z()};
  dBodySetPosition(node.body, p.x(), p.y(), p.z());
  dBodySetQuaternion(node.body, q);
  dBodySetLinearVel(node.body, v.x(), v.y(), v.z());
  dBodySetAngularVel(node.body, w.x(), w.y(), w.z());
  placeGeom(node);
  copyPose(node);
  wakeBody(node);
}

// Rotations are multiplied in 32 bits here, and only a step makes an orthonormal matrix of the product again.
// A sleeping robot makes no step: the error of one placement goes into the next, doubles, and after some
// fifty of them ODE ends the process. Errors of a single placement are left as they are, as in the server.
Eigen::Matrix3f withoutDrift(const Eigen::Matrix3f& rotation) {
  constexpr float kDrift = 1e-5F;  // a hundred times the error of one product
  const Eigen::Matrix3f error = rotation.transpose() * rotation - Eigen::Matrix3f::Identity();
  if (error.cwiseAbs().maxCoeff() < kDrift) return rotation;
  return Eigen::Quaternionf(rotation).normalized().toRotationMatrix();
}

}  // namespace

void World::Implementation::moveRobot(RobotNode& robot, const Vector3f& position) {
  if (!position.allFinite()) return;                          // ODE would end the process
  const Vector3f torso = robot.bodies.front().pose.position;  // before any move of this cycle (facts 4.8)
  for (BodyNode& body : robot.bodies) {
    const Vector3f target = position + (scene::fromOde(dBodyGetPosition(body.body)) - torso);
    dBodySetPosition(body.body, target.x(), target.y(), target.z());
    stop(body.body);
    placeGeom(body);
  }
}

void World::Implementation::placeRobot(RobotNode& robot, const Vector3f& position, float yawDegrees) {
  if (!position.allFinite() || !std::isfinite(yawDegrees)) return;
  const dBodyID torso = robot.bodies.front().body;
  const Vector3f origin = scene::fromOde(dBodyGetPosition(torso));
  const Eigen::Matrix3f back = scene::rotationFromOde(dBodyGetRotation(torso)).transpose();
  const Eigen::Matrix3f turn = scene::multiply(scene::rotationZ(scene::toRadians(yawDegrees)), back);
  for (BodyNode& body : robot.bodies) {
    const Vector3f place = scene::fromOde(dBodyGetPosition(body.body));
    const Eigen::Matrix3f rotation =
        withoutDrift(scene::multiply(turn, scene::rotationFromOde(dBodyGetRotation(body.body))));
    const Vector3f target = position + scene::rotate(turn, place - origin);
    dBodySetPosition(body.body, target.x(), target.y(), target.z());
    stop(body.body);
    dMatrix3 matrix;
    scene::toOde(rotation, matrix);
    dBodySetRotation(body.body, matrix);
    placeGeom(body);
  }
}

void World::Implementation::runDeferred(RobotNode& robot, World::DeferredBy effector) {
  if (robot.deferred && robot.deferred->effector == effector) {
    placeRobot(robot, robot.deferred->position, robot.deferred->yawDegrees);
  }
}

void World::moveRobot(RobotHandle robot, const Vector3f& position) {
  implementation_->moveRobot(implementation_->robot(robot), position);
}
void World::placeRobot(RobotHandle robot, const Vector3f& position, float yawDegrees) {
  implementation_->placeRobot(implementation_->robot(robot), position, yawDegrees);
}
void World::deferPlacement(RobotHandle robot, DeferredBy effector, const Vector3f& position,
                           float yawDegrees) {
  implementation_->robot(robot).deferred = {effector, position, yawDegrees};
}

World::BodyState World::bodyState(RobotHandle robot, model::BodyId body) const {
  return stateOf(implementation_->robot(robot).body(body).body);
}
void World::setBodyState(RobotHandle robot, model::BodyId body, const BodyState& state) {
  RobotNode& node = implementation_->robot(robot);
  setState(node.body(body), state);
  if (body == model::BodyId::Torso) node.lastVelocity = state.velocity.cast<float>();
}
void World::setAsleep(RobotHandle robot, bool asleep) {
  for (BodyNode& body : implementation_->robot(robot).bodies) {
    if (asleep) {
      stop(body.body);
      setCountdown(body, 0);
      dBodyDisable(body.body);
    } else {
      wakeBody(body);
    }
  }
}
bool World::isAsleep(RobotHandle robot) const {
  return dBodyIsEnabled(implementation_->robot(robot).bodies.front().body) == 0;
}

Vector3f World::ballPosition() const {
  return scene::fromOde(dBodyGetPosition(implementation_->ball.body));
}
Vector3f World::ballVelocity() const {
  return scene::fromOde(dBodyGetLinearVel(implementation_->ball.body));
}
Vector3f World::ballAngularVelocity() const {
  return scene::fromOde(dBodyGetAngularVel(implementation_->ball.body));
}
const ScenePose& World::ballPose() const {
  return implementation_->ball.pose;
}
void World::setBallPosition(const Vector3f& position) {
  if (!position.allFinite()) return;
  BodyNode& ball = implementation_->ball;
  dBodySetPosition(ball.body, position.x(), position.y(), position.z());
  placeGeom(ball);
  wakeBody(ball);
}
void World::setBallVelocity(const Vector3f& velocity) {
  if (!velocity.allFinite()) return;
  BodyNode& ball = implementation_->ball;
  dBodySetLinearVel(ball.body, velocity.x(), velocity.y(), velocity.z());
  dBodySetAngularVel(ball.body, 0.0, 0.0, 0.0);
  wakeBody(ball);
}
void World::setBallState(const BodyState& state) {
  setState(implementation_->ball, state);
}

}  // namespace nonet::sim
