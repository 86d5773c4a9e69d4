// Builds the physics world: field, goals, ball and robots, in the server's order of creation (server facts
// 2.2, 3.3). That order decides the order of ODE's lists, hence of contacts and constraint rows, hence the
// last bits of every result.
#include <algorithm>
#include <stdexcept>
#include <string>

#include "nonet/math/angle.h"

#include "sim/world_implementation.h"
#include "sim/world_scene.h"

namespace nonet::sim {

namespace {

using model::BodyId;
using model::JointId;
using scene::scriptNumber;

// Server facts 3.2, first table.
const Surface kGroundSurface{.softErp = true, .slips = true, .erp = 0.2F, .slip = 5e-3F};
const Surface kRobotSurface{
    .softErp = true, .softCfm = true, .slips = true, .erp = 0.6F, .cfm = 1e-4F, .slip = 5e-3F};
const Surface kBallSurface{.bounces = true,
                           .softErp = true,
                           .softCfm = true,
                           .slips = true,
                           .bounce = 0.8F,
                           .bounceVelocity = 0.8F,
                           .erp = 0.5F,
                           .cfm = 0.05F,
                           .slip = 0.6F};
const Surface kFrameSurface{.bounces = true, .bounce = 0.8F, .bounceVelocity = 2.0F};
const Surface kTriggerSurface{.contacts = false};

const Vector3f kBirthPlace{0.0F, -1.0F, 1.5F};  // of a robot's torso

// Speed limit of the joints that are given in degrees per second, after the script's arithmetic.
double defaultJointSpeed() {
  return scriptNumber(3.14159265 * scriptNumber(351.77 / 180.0));
}

/// From the model's robot frame (x forward, y left) to the server's body frame (x right, y forward).
Vector3 toServer(const Vector3& v) {
  return {0.0 - v.y(), v.x(), v.z()};
}

/// Extents of a box: no sign.
Vector3 extentsToServer(const Vector3& size) {
  return {size.y(), size.x(), size.z()};
}

Vector3f rounded(const Vector3& v) {
  return {static_cast<float>(scriptNumber(v.x())), static_cast<float>(scriptNumber(v.y())),
          static_cast<float>(scriptNumber(v.z()))};
}

// A robot part as the scene description computes it.
struct Part {
  Vector3 offset = Vector3::Zero();   // to the parent's centre, server axes
  Vector3 extents = Vector3::Zero();  // box
  Vector3 anchor = Vector3::Zero();   // of its joint, own frame
  double mass = 0.0;
};

// The description of type 4 computes foot and toe from the toe's length; each step is rounded to six digits.
void adjustFootWithToe(const model::RobotModel& model, BodyId id, Part& part) {
  constexpr double kFootLength = 0.16;
  constexpr double kFootMass = 0.2;
  const double toeLength = scriptNumber(model.body(BodyId::RToe).shape.size.x());
  const double share = scriptNumber(scriptNumber(toeLength / kFootLength) * 0.5);
  if (id == BodyId::RFoot || id == BodyId::LFoot) {
    const double footLength = scriptNumber(kFootLength - toeLength);
    part.extents.y() = footLength;
    part.mass = scriptNumber(scriptNumber(1.0 - share) * kFootMass);
    part.offset.y() = scriptNumber(scriptNumber(footLength * 0.5) - 0.05);
  } else if (id == BodyId::RToe || id == BodyId::LToe) {
    part.extents.y() = toeLength;
    part.mass = scriptNumber(share * kFootMass);
    part.anchor.y() = scriptNumber(-0.5 * toeLength);
  }
}

Part partFor(const model::RobotModel& model, const model::BodySpec& spec) {
  Part part;
  part.offset = toServer(spec.offset);
  part.extents = extentsToServer(spec.shape.size);
  part.mass = spec.mass;
  if (spec.joint) part.anchor = toServer(model.joint(*spec.joint).anchor);
  if (model.hasToes()) adjustFootWithToe(model, spec.id, part);
  return part;
}

void setMass(dBodyID body, const model::Shape& shape, const Part& part) {
  dMass mass;
  const auto total = static_cast<float>(part.mass);
  switch (shape.kind) {
    case model::ShapeKind::Box: {
      const Vector3f size = part.extents.cast<float>();
      dMassSetBoxTotal(&mass, total, size.x(), size.y(), size.z());
      break;
    }
    case model::ShapeKind::Sphere:
      dMassSetSphereTotal(&mass, total, static_cast<float>(shape.size.x()));
      break;
    case model::ShapeKind::Capsule:
      dMassSetCapsuleTotal(&mass, total, 3, static_cast<float>(shape.size.x()),
                           static_cast<float>(shape.size.y()));
      break;
  }
  dBodySetMass(body, &mass);
}

dGeomID createGeom(const model::Shape& shape, const Part& part) {
  switch (shape.kind) {
    case model::ShapeKind::Box: {
      const Vector3f size = part.extents.cast<float>();
      return dCreateBox(nullptr, size.x(), size.y(), size.z());
    }
    case model::ShapeKind::Sphere:
      return dCreateSphere(nullptr, static_cast<float>(shape.size.x()));
    case model::ShapeKind::Capsule:
      return dCreateCapsule(nullptr, static_cast<float>(shape.size.x()), static_cast<float>(shape.size.y()));
  }
  return nullptr;
}

void placeBody(dBodyID body, const ScenePose& pose) {
  dMatrix3 rotation;
  scene::toOde(pose.rotation, rotation);
  dBodySetRotation(body, rotation);
  dBodySetPosition(body, pose.position.x(), pose.position.y(), pose.position.z());
}

// Server facts 2.4: parameters are 32-bit on their way to ODE.
void setMotor(dJointID joint, const JointNode& node) {
  dJointSetHingeParam(joint, dParamFMax, 10.0F);
  dJointSetHingeParam(joint, dParamCFM, 1e-8F);
  dJointSetHingeParam(joint, dParamStopCFM, 1e-8F);
  dJointSetHingeParam(joint, dParamStopERP, 0.8F);
  dJointSetHingeParam(joint, dParamFudgeFactor, 1e-5F);
  dJointSetHingeParam(joint, dParamBounce, 1.0F);
  dJointSetHingeParam(joint, dParamLoStop, node.lowStop);
  dJointSetHingeParam(joint, dParamHiStop, node.highStop);
}

JointNode createJoint(dWorldID world, const model::JointSpec& spec, const Part& part, const BodyNode& child,
                      dBodyID parent) {
  JointNode node;
  node.id = spec.id;
  node.child = child.body;
  node.childId = child.id;
  const bool byDegrees = std::abs(spec.maxSpeed - toRadians(351.77)) < 1e-9;
  node.maxSpeed = static_cast<float>(byDegrees ? defaultJointSpeed() : scriptNumber(spec.maxSpeed));
  node.lowStop = scene::toRadians(static_cast<float>(std::round(toDegrees(spec.low))));
  node.highStop = scene::toRadians(static_cast<float>(std::round(toDegrees(spec.high))));
  node.joint = dJointCreateHinge(world, nullptr);
  dJointAttach(node.joint, child.body, parent);
  const Vector3f anchor = scene::transform(child.pose, rounded(part.anchor));
  dJointSetHingeAnchor(node.joint, anchor.x(), anchor.y(), anchor.z());
  // The hip's axis is written as 0.7071, ODE normalises it.
  const Vector3 scaled = toServer(spec.axis).unaryExpr(
      [](double c) { return std::abs(std::abs(c) - 0.7071) < 1e-4 ? std::copysign(0.7071, c) : c; });
  const Vector3f axis = scene::rotate(child.pose.rotation, rounded(scaled));
  dJointSetHingeAxis(node.joint, axis.x(), axis.y(), axis.z());
  setMotor(node.joint, node);
  return node;
}

bool isFoot(BodyId id) {
  return id == BodyId::RFoot || id == BodyId::LFoot || id == BodyId::RToe || id == BodyId::LToe;
}

}  // namespace

void World::Implementation::addBox(dSpaceID parent, const ScenePose& pose, const Vector3f& size,
                                   const Surface& surface, Goal trigger) {
  auto collider = std::make_unique<Collider>();
  collider->surface = &surface;
  collider->trigger = trigger;
  const dGeomID geom = dCreateBox(nullptr, size.x(), size.y(), size.z());
  dGeomSetData(geom, collider.get());
  dSpaceAdd(parent, geom);
  dMatrix3 rotation;
  scene::toOde(pose.rotation, rotation);
  dGeomSetRotation(geom, rotation);
  dGeomSetPosition(geom, pose.position.x(), pose.position.y(), pose.position.z());
  fixtures.push_back(geom);
  fixtureColliders.push_back(std::move(collider));
}

void World::Implementation::buildGoal(Goal side) {
  constexpr double kBar = 0.04;
  const double halfWidth = settings.goalWidth / 2.0;
  const double halfHeight = settings.goalHeight / 2.0;
  const double halfDepth = settings.goalDepth / 2.0;
  const double diameter = 2.0 * settings.ballRadius;
  const double x = settings.fieldLength / 2.0 + halfDepth;
  const bool left = side == Goal::Left;
  dSpaceID& goal = left ? leftGoal : rightGoal;
  goal = dHashSpaceCreate(space);
  dSpaceSetCleanup(goal, 0);
  ScenePose frame;
  frame.position = rounded({left ? -x : x, 0.0, halfHeight});
  frame.rotation = scene::rotationZ(scene::toRadians(left ? 0.0F : 180.0F));
  const auto part = [&](const Vector3& offset, const Vector3& size, const Surface& surface, Goal trigger) {
    const ScenePose pose{frame.rotation, scene::transform(frame, rounded(offset))};
    addBox(goal, pose, rounded(size), surface, trigger);
  };
  const Vector3 bar(settings.goalDepth, kBar, settings.goalHeight);
  const double roofWidth = settings.goalWidth + 2.0 * kBar;
  part({0, 0, 0}, {settings.goalDepth - diameter, settings.goalWidth - diameter, settings.goalHeight},
       kTriggerSurface, side);
  part({0, -(halfWidth + kBar / 2.0), 0}, bar, kFrameSurface, Goal::None);
  part({0, halfWidth + kBar / 2.0, 0}, bar, kFrameSurface, Goal::None);
  part({-(halfDepth - kBar / 2.0), 0, 0}, {kBar, settings.goalWidth, settings.goalHeight}, kFrameSurface,
       Goal::None);
  part({0, 0, halfHeight + kBar / 2.0}, {settings.goalDepth, roofWidth, kBar}, kFrameSurface, Goal::None);
}

void World::Implementation::buildField() {
  auto ground = std::make_unique<Collider>();
  ground->surface = &kGroundSurface;
  const dGeomID plane = dCreatePlane(nullptr, 0.0, 0.0, 1.0, 0.0);
  dGeomSetData(plane, ground.get());
  dSpaceAdd(space, plane);
  fixtures.push_back(plane);
  fixtureColliders.push_back(std::move(ground));

  buildGoal(Goal::Left);
  buildGoal(Goal::Right);

  // Outer walls (server facts 3.3), at distances that scale with the field.
  constexpr double kWall = 1.0;
  const double borderX = scriptNumber(settings.fieldLength * 0.333);
  const double borderY = scriptNumber(settings.fieldWidth * 0.75);
  const double wallX = settings.fieldLength / 2.0 + borderX;
  const double wallY = settings.fieldWidth / 2.0 + borderY;
  const double lengthX = kWall + 2.0 * wallX;
  const double lengthY = kWall + 2.0 * wallY;
  const auto wall = [&](const Vector3& position, const Vector3& size) {
    addBox(space, {Eigen::Matrix3f::Identity(), rounded(position)}, rounded(size), kFrameSurface);
  };
  wall({-wallX, 0, 0}, {kWall, lengthY, kWall});
  wall({wallX, 0, 0}, {kWall, lengthY, kWall});
  wall({0, wallY, 0}, {lengthX, kWall, kWall});
  wall({0, -wallY, 0}, {lengthX, kWall, kWall});
}

void World::Implementation::buildBall() {
  const auto radius = static_cast<float>(settings.ballRadius);
  ball.pose.position = Vector3f(0.0F, 0.0F, radius);
  ball.collider.party.kind = ContactParty::Kind::Ball;
  ball.collider.surface = &kBallSurface;
  ball.body = dBodyCreate(world);
  placeBody(ball.body, ball.pose);
  ball.geom = dCreateSphere(nullptr, radius);
  dGeomSetData(ball.geom, &ball.collider);
  dSpaceAdd(space, ball.geom);
  dGeomSetBody(ball.geom, ball.body);
  dMass mass;
  dMassSetSphereTotal(&mass, static_cast<float>(settings.ballMass), radius);
  dBodySetMass(ball.body, &mass);
}

RobotHandle World::Implementation::addRobot(int type) {
  const RobotHandle handle = nextHandle++;
  addRobotAs(handle, type);
  return handle;
}

void World::Implementation::addRobotAs(RobotHandle handle, int type) {
  const model::RobotModel& model = model::robotModel(type);
  auto node = std::make_unique<RobotNode>();
  RobotNode& robot = *node;
  robot.handle = handle;
  robot.type = type;
  robot.bodyIndex.fill(-1);
  robot.jointIndex.fill(-1);
  robot.space = dHashSpaceCreate(space);
  dSpaceSetCleanup(robot.space, 0);
  robot.bodies.reserve(model.bodies().size());
  std::array<Vector3, model::kBodyCount> places;  // as the description computes them, server axes
  for (const model::BodySpec& spec : model.bodies()) {
    const Part part = partFor(model, spec);
    Vector3& place = places[index(spec.id)];
    if (spec.joint) {
      const Vector3& parent = places[index(spec.parent)];
      for (int i = 0; i < 3; ++i) place[i] = scriptNumber(parent[i] + scriptNumber(part.offset[i]));
    } else {
      place = kBirthPlace.cast<double>();
    }
    robot.bodyIndex[index(spec.id)] = static_cast<int>(robot.bodies.size());
    BodyNode& body = robot.bodies.emplace_back();
    body.id = spec.id;
    body.pose.position = place.cast<float>();
    body.collider.party = {ContactParty::Kind::Robot, handle, spec.id};
    body.collider.surface = &kRobotSurface;
    body.body = dBodyCreate(world);
    placeBody(body.body, body.pose);
    setMass(body.body, spec.shape, part);
    if (spec.collider) {
      body.geom = createGeom(spec.shape, part);
      dGeomSetData(body.geom, &body.collider);
      dSpaceAdd(robot.space, body.geom);
      dGeomSetBody(body.geom, body.body);
    }
    if (isFoot(spec.id)) {
      body.collider.footSensor = static_cast<int>(robot.feet.size());
      robot.feet.emplace_back().body = spec.id;
    }
    if (spec.joint) {
      robot.jointIndex[index(*spec.joint)] = static_cast<int>(robot.joints.size());
      robot.joints.push_back(
          createJoint(world, model.joint(*spec.joint), part, body, robot.body(spec.parent).body));
    }
  }
  handles.push_back(handle);
  robots.push_back(std::move(node));
}

void World::Implementation::destroyRobot(RobotNode& robot) {
  for (const JointNode& joint : robot.joints) dJointDestroy(joint.joint);
  for (const BodyNode& body : robot.bodies) {
    if (body.geom != nullptr) dGeomDestroy(body.geom);
    dBodyDestroy(body.body);
  }
  dSpaceDestroy(robot.space);
}

void World::Implementation::removeRobot(RobotHandle handle) {
  destroyRobot(robot(handle));
  std::erase(handles, handle);
  std::erase_if(robots, [handle](const auto& node) { return node->handle == handle; });
}

RobotNode& World::Implementation::robot(RobotHandle handle) {
  for (const auto& node : robots) {
    if (node->handle == handle) return *node;
  }
  throw std::out_of_range("no robot with handle " + std::to_string(handle) + " in this world");
}

}  // namespace nonet::sim
