#include "nonet/sim/physics/world.h"

#include <cmath>

#include "sim/physics/scene.h"
#include "sim/physics/world_implementation.h"

namespace nonet::sim {

World::Implementation::Implementation(const WorldSettings& worldSettings)
    : settings(worldSettings), workers(worldSettings.threads, worldSettings.threadPatience) {
  prepareOdeThread();
  space = dHashSpaceCreate(nullptr);
  dSpaceSetCleanup(space, 0);
  buildField();
  buildBall();
}

World::Implementation::~Implementation() {
  commonWorlds.clear();
  for (const auto& robot : robots) destroyRobot(*robot);
  dGeomDestroy(ball.geom);
  for (dGeomID geom : fixtures) dGeomDestroy(geom);
  dSpaceDestroy(leftGoal);
  dSpaceDestroy(rightGoal);
  dSpaceDestroy(space);
}

World::World(const WorldSettings& settings) : implementation_(std::make_unique<Implementation>(settings)) {}
World::~World() = default;

double World::time() const {
  return static_cast<double>(implementation_->cycles) * kCycleTime;
}

RobotHandle World::addRobot(int type) {
  return implementation_->addRobot(type);
}
void World::removeRobot(RobotHandle robot) {
  implementation_->removeRobot(robot);
}
std::span<const RobotHandle> World::robots() const {
  return implementation_->handles;
}
int World::robotType(RobotHandle robot) const {
  return implementation_->robot(robot).type;
}

// Server facts 2.4. Angles are compared in degrees, as there.
void World::setJointSpeed(RobotHandle robot, model::JointId joint, float radPerSecond) {
  JointNode* node = implementation_->robot(robot).joint(joint);
  if (node == nullptr || std::isnan(radPerSecond)) return;  // an ODE that has met a NaN never recovers
  float speed = radPerSecond > 0.0F ? (radPerSecond < node->maxSpeed ? radPerSecond : node->maxSpeed)
                                    : (radPerSecond > -node->maxSpeed ? radPerSecond : -node->maxSpeed);
  if (node->frozen) speed = 0.0F;
  const float angle = jointAngleDegrees(robot, joint);
  if (angle < node->highStop * 180.0 / M_PI && angle > node->lowStop * 180.0 / M_PI) {
    dJointSetHingeParam(node->joint, dParamVel, speed);
  }
  if (radPerSecond != 0.0F && dBodyIsEnabled(node->child) == 0)
    wakeBody(implementation_->robot(robot).body(node->childId));
}

void World::freezeJoint(RobotHandle robot, model::JointId joint, bool frozen) {
  if (JointNode* node = implementation_->robot(robot).joint(joint)) node->frozen = frozen;
}
bool World::isFrozen(RobotHandle robot, model::JointId joint) const {
  const JointNode* node = implementation_->robot(robot).joint(joint);
  return node != nullptr && node->frozen;
}
float World::jointAngleDegrees(RobotHandle robot, model::JointId joint) const {
  const RobotNode& node = implementation_->robot(robot);
  const int i = node.jointIndex[index(joint)];
  if (i < 0) return 0.0F;
  return static_cast<float>(node.multibody.mechanism.angle(static_cast<std::size_t>(i)) * (180.0 / M_PI));
}
float World::jointAngle(RobotHandle robot, model::JointId joint) const {
  return scene::toRadians(jointAngleDegrees(robot, joint));
}

const ScenePose& World::bodyPose(RobotHandle robot, model::BodyId body) const {
  return implementation_->robot(robot).body(body).pose;
}
Vector3f World::bodyPosition(RobotHandle robot, model::BodyId body) const {
  return scene::fromOde(dBodyGetPosition(implementation_->robot(robot).body(body).body));
}
Vector3f World::bodyVelocity(RobotHandle robot, model::BodyId body) const {
  return scene::fromOde(dBodyGetLinearVel(implementation_->robot(robot).body(body).body));
}
Vector3f World::gyro(RobotHandle robot) const {
  const dBodyID torso = implementation_->robot(robot).bodies.front().body;
  return scene::inverseDirection(scene::rotationFromOde(dBodyGetRotation(torso)),
                                 scene::fromOde(dBodyGetAngularVel(torso)));
}
Vector3f World::accelerometer(RobotHandle robot) const {
  return implementation_->robot(robot).acceleration;
}
std::optional<FootContact> World::footContact(RobotHandle robot, model::BodyId foot) const {
  const RobotNode& node = implementation_->robot(robot);
  for (const FootSensor& sensor : node.feet) {
    if (sensor.body == foot && sensor.inContact) return sensor.last;
  }
  return std::nullopt;
}

World::Goal World::ballInGoal() const {
  return implementation_->ballInGoal;
}

void World::prePhysics() {
  implementation_->prePhysics();
}
void World::share(const SharedWork& work) const {
  implementation_->workers.run(work.count, work.piece);
}
void World::stepPhysics(const SharedWork& alongside) {
  prepareOdeThread();
  implementation_->stepPhysics(alongside);
}
std::span<const ContactPair> World::contacts() const {
  return implementation_->contacts;
}

std::vector<std::uint8_t> World::save() const {
  return implementation_->save();
}
void World::restore(std::span<const std::uint8_t> state) {
  implementation_->restore(state);
}

}  // namespace nonet::sim
