// Builds the physics world: field, goals, ball and robots, in the server's order of creation (server facts
// 2.2, 3.3). That order decides the order of ODE's lists, hence of contacts and constraint rows, hence the
// last bits of every result.
#include <algorithm>
#include <stdexcept>
#include <string>

#include "nonet/math/angle.h"

#include "sim/physics/scene.h"
#include "sim/physics/world_implementation.h"

namespace nonet::sim {

namespace {

using model::BodyId;
using scene::scriptNumber;
using scene::scriptVector;

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

dGeomID createGeom(const RobotPlan::Body& part) {
  switch (part.shape) {
    case model::ShapeKind::Box:
      return dCreateBox(nullptr, part.size.x(), part.size.y(), part.size.z());
    case model::ShapeKind::Sphere:
      return dCreateSphere(nullptr, part.size.x());
    case model::ShapeKind::Capsule:
      return dCreateCapsule(nullptr, part.size.x(), part.size.y());
  }
  return nullptr;
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
  frame.position = scriptVector({left ? -x : x, 0.0, halfHeight});
  frame.rotation = scene::rotationZ(scene::toRadians(left ? 0.0F : 180.0F));
  const auto part = [&](const Vector3& offset, const Vector3& size, const Surface& surface, Goal trigger) {
    const ScenePose pose{frame.rotation, scene::transform(frame, scriptVector(offset))};
    addBox(goal, pose, scriptVector(size), surface, trigger);
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
    addBox(space, {Eigen::Matrix3f::Identity(), scriptVector(position)}, scriptVector(size), kFrameSurface);
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
  ball.collider.node = &ball;
  ball.collider.multibody = &ballMultibody;
  ballMultibody.mechanism =
      sim::buildBall(ballMultibody.world.id(), radius, static_cast<float>(settings.ballMass));
  ballMultibody.nodes = {&ball};
  ball.body = ballMultibody.mechanism.bodies.front();
  watchBody(ball);
  ball.geom = dCreateSphere(nullptr, radius);
  dGeomSetData(ball.geom, &ball.collider);
  dSpaceAdd(space, ball.geom);
  placeGeom(ball);
}

RobotHandle World::Implementation::addRobot(int type) {
  const RobotHandle handle = nextHandle++;
  addRobotAs(handle, type);
  return handle;
}

void World::Implementation::addRobotAs(RobotHandle handle, int type) {
  model::robotModel(type);  // throws if there is no such type
  const RobotPlan& plan = robotPlan(type);
  auto node = std::make_unique<RobotNode>();
  RobotNode& robot = *node;
  robot.handle = handle;
  robot.type = type;
  robot.bodyIndex.fill(-1);
  robot.jointIndex.fill(-1);
  robot.space = dHashSpaceCreate(space);
  dSpaceSetCleanup(robot.space, 0);
  robot.multibody.mechanism = buildMechanism(robot.multibody.world.id(), plan);
  robot.multibody.robotType = type;
  robot.multibody.handle = handle;
  robot.bodies.resize(plan.bodies.size());
  for (std::size_t i = 0; i < plan.bodies.size(); ++i) {
    const RobotPlan::Body& part = plan.bodies[i];
    BodyNode& body = robot.bodies[i];
    robot.bodyIndex[index(part.id)] = static_cast<int>(i);
    robot.multibody.nodes.push_back(&body);
    body.place = i;
    body.id = part.id;
    body.pose = part.pose;
    body.body = robot.multibody.mechanism.bodies[i];
    watchBody(body);
    body.collider.party = {ContactParty::Kind::Robot, handle, part.id};
    body.collider.surface = &kRobotSurface;
    body.collider.node = &body;
    body.collider.multibody = &robot.multibody;
    if (part.collider) {
      body.geom = createGeom(part);
      dGeomSetData(body.geom, &body.collider);
      dSpaceAdd(robot.space, body.geom);
      placeGeom(body);
    }
    if (isFoot(part.id)) {
      body.collider.footSensor = static_cast<int>(robot.feet.size());
      robot.feet.emplace_back().body = part.id;
    }
    if (part.joint) {
      BodyNode& parent = robot.bodies[part.joint->parent];
      body.neighbours.push_back(&parent);
      parent.neighbours.push_back(&body);
      robot.jointIndex[index(part.joint->id)] = static_cast<int>(robot.joints.size());
      robot.joints.push_back({part.joint->id, robot.multibody.mechanism.joints[robot.joints.size()],
                              body.body, part.id, part.joint->maxSpeed, part.joint->lowStop,
                              part.joint->highStop, false});
    }
  }
  handles.push_back(handle);
  robots.push_back(std::move(node));
}

void World::Implementation::destroyRobot(RobotNode& robot) {
  for (const BodyNode& body : robot.bodies) {
    if (body.geom != nullptr) dGeomDestroy(body.geom);
  }
  dSpaceDestroy(robot.space);
}

void World::Implementation::removeRobot(RobotHandle handle) {
  destroyRobot(robot(handle));
  commonWorlds.forget(handle);
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
