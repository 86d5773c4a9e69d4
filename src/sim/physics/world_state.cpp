// Saving and restoring a world, bit by bit. Robots are built anew in their order of creation, then get their
// state. ODE gives no setters for some of it:
//  - quaternion and rotation matrix are written through the pointers ODE hands out (its setters normalise);
//  - the steps left until auto-disable are followed beside ODE (followSleep) and set by way of dBodyEnable;
//  - the order of the geoms in their spaces, which decides the order of the contacts, and which of them ODE
//    holds for moved, is rebuilt by removing and adding them.
#include <algorithm>
#include <stdexcept>

#include "sim/physics/hash.h"
#include "sim/physics/state_bytes.h"
#include "sim/physics/world_implementation.h"

namespace nonet::sim {

namespace {

constexpr std::uint32_t kFormat = 0x4E575231;  // "NWR1"

using Bytes = std::vector<std::uint8_t>;
using Input = std::span<const std::uint8_t>;

void demand(bool holds) {
  if (!holds) throw std::runtime_error("saved world: is damaged");
}

void putParty(Bytes& out, const ContactParty& party) {
  put(out, party.kind);
  put(out, party.robot);
  put(out, party.body);
}

ContactParty takenParty(Input& in) {
  ContactParty party;
  take(in, party.kind);
  take(in, party.robot);
  take(in, party.body);
  demand(party.kind <= ContactParty::Kind::Robot && model::index(party.body) < model::kBodyCount);
  return party;
}

void saveBody(Bytes& out, const BodyNode& node) {
  const dBodyID body = node.body;
  putArray(out, dBodyGetPosition(body), 3);
  putArray(out, dBodyGetQuaternion(body), 4);
  putArray(out, dBodyGetRotation(body), 12);
  putArray(out, dBodyGetLinearVel(body), 3);
  putArray(out, dBodyGetAngularVel(body), 3);
  putArray(out, dBodyGetForce(body), 3);
  putArray(out, dBodyGetTorque(body), 3);
  put(out, dBodyIsEnabled(body) != 0);
  put(out, node.stepsUntilSleep);
  put(out, node.moved);
  put(out, node.pose);
}

void restoreBody(Input& in, BodyNode& node) {
  const dBodyID body = node.body;
  dReal v[4];
  takeArray(in, v, 3);
  dBodySetPosition(body, v[0], v[1], v[2]);
  takeArray(in, const_cast<dReal*>(dBodyGetQuaternion(body)), 4);
  takeArray(in, const_cast<dReal*>(dBodyGetRotation(body)), 12);
  takeArray(in, v, 3);
  dBodySetLinearVel(body, v[0], v[1], v[2]);
  takeArray(in, v, 3);
  dBodySetAngularVel(body, v[0], v[1], v[2]);
  takeArray(in, v, 3);
  dBodySetForce(body, v[0], v[1], v[2]);
  takeArray(in, v, 3);
  dBodySetTorque(body, v[0], v[1], v[2]);
  const bool enabled = taken<bool>(in);
  setCountdown(node, taken<int>(in));
  if (!enabled) dBodyDisable(body);
  const bool moved = taken<bool>(in);
  placeGeom(node);
  node.moved = moved;
  node.pose = taken<ScenePose>(in);
}

/// Puts the geoms into the space so that its list reads as in `order`, the moved ones before the others.
void refillSpace(dSpaceID space, const std::vector<dGeomID>& order, const std::vector<bool>& moved) {
  for (dGeomID geom : order) {
    if (dSpaceQuery(space, geom) != 0) dSpaceRemove(space, geom);
  }
  bool cleaned = false;
  for (std::size_t i = order.size(); i-- > 0;) {
    if (moved[i] && !cleaned) {
      dSpaceClean(space);
      cleaned = true;
    }
    dSpaceAdd(space, order[i]);
  }
  if (!cleaned) dSpaceClean(space);
}

bool anyMoved(const RobotNode& robot) {
  for (const BodyNode& body : robot.bodies) {
    if (body.geom != nullptr && body.moved) return true;
  }
  return false;
}

void saveRobot(Bytes& out, const RobotNode& robot) {
  put(out, robot.handle);
  put(out, robot.type);
  for (const BodyNode& body : robot.bodies) saveBody(out, body);
  for (const JointNode& joint : robot.joints) {
    put(out, dJointGetHingeParam(joint.joint, dParamVel));
    put(out, joint.frozen);
  }
  put(out, robot.lastVelocity);
  put(out, robot.acceleration);
  for (const FootSensor& foot : robot.feet) {
    put(out, foot.inContact);
    put(out, foot.last.center);
    put(out, foot.last.force);
  }
  const int geoms = dSpaceGetNumGeoms(robot.space);
  put(out, geoms);
  for (int i = 0; i < geoms; ++i) {
    put(out, static_cast<const Collider*>(dGeomGetData(dSpaceGetGeom(robot.space, i)))->party.body);
  }
}

void restoreRobot(Input& in, RobotNode& robot) {
  for (BodyNode& body : robot.bodies) restoreBody(in, body);
  for (JointNode& joint : robot.joints) {
    dJointSetHingeParam(joint.joint, dParamVel, taken<dReal>(in));
    joint.frozen = taken<bool>(in);
  }
  robot.lastVelocity = taken<Vector3f>(in);
  robot.acceleration = taken<Vector3f>(in);
  for (FootSensor& foot : robot.feet) {
    foot.inContact = taken<bool>(in);
    foot.last.center = taken<Vector3f>(in);
    foot.last.force = taken<Vector3f>(in);
  }
  // Each geom once: ODE does not check what is put into a space.
  demand(taken<int>(in) == dSpaceGetNumGeoms(robot.space));
  std::vector<dGeomID> order;
  std::vector<bool> moved;
  for (int i = 0; i < dSpaceGetNumGeoms(robot.space); ++i) {
    const auto id = taken<model::BodyId>(in);
    demand(model::index(id) < model::kBodyCount && robot.bodyIndex[model::index(id)] >= 0);
    const BodyNode& body = robot.body(id);
    demand(body.geom != nullptr && std::ranges::count(order, body.geom) == 0);
    order.push_back(body.geom);
    moved.push_back(body.moved);
  }
  refillSpace(robot.space, order, moved);
}

// Members of the world's own space, by number: ball, then fixed parts, goals and robots.
constexpr int kBallMember = -1;
constexpr int kLeftGoalMember = -2;
constexpr int kRightGoalMember = -3;
constexpr int kFirstFixture = 1'000'000;

}  // namespace

std::vector<std::uint8_t> World::Implementation::save() const {
  Bytes out;
  put(out, kFormat);
  put(out, cycles);
  put(out, nextHandle);
  put(out, ballInGoal);
  put(out, fixturesMoved);
  saveBody(out, ball);
  put(out, robots.size());
  for (const auto& robot : robots) saveRobot(out, *robot);
  put(out, contacts.size());
  for (const ContactPair& pair : contacts) {
    putParty(out, pair.first);
    putParty(out, pair.second);
    put(out, pair.pointCount);
    put(out, pair.meanPosition);
  }
  const int members = dSpaceGetNumGeoms(space);
  put(out, members);
  for (int i = 0; i < members; ++i) put(out, memberNumber(dSpaceGetGeom(space, i)));
  return out;
}

void World::Implementation::restore(std::span<const std::uint8_t> state) {
  Input in = state;
  if (taken<std::uint32_t>(in) != kFormat) throw std::runtime_error("saved world: unknown format");
  for (const auto& robot : robots) destroyRobot(*robot);
  robots.clear();
  commonWorlds.clear();
  handles.clear();
  cycles = taken<std::uint64_t>(in);
  nextHandle = taken<RobotHandle>(in);
  ballInGoal = taken<Goal>(in);
  demand(ballInGoal <= Goal::Right);
  fixturesMoved = taken<bool>(in);
  restoreBody(in, ball);
  const auto robotCount = taken<std::size_t>(in);
  for (std::size_t i = 0; i < robotCount; ++i) {
    const auto handle = taken<RobotHandle>(in);
    const int type = taken<int>(in);
    demand(handle >= 0 && handle < nextHandle && std::ranges::count(handles, handle) == 0);
    demand(type >= 0 && type < model::kRobotTypeCount);
    addRobotAs(handle, type);
    restoreRobot(in, *robots.back());
  }
  contacts.clear();
  const auto contactCount = taken<std::size_t>(in);
  for (std::size_t i = 0; i < contactCount; ++i) {
    ContactPair pair;
    pair.first = takenParty(in);
    pair.second = takenParty(in);
    pair.pointCount = taken<int>(in);
    pair.meanPosition = taken<Vector3f>(in);
    contacts.push_back(pair);
  }
  restoreMembers(in);
  if (!in.empty()) throw std::runtime_error("saved world: data after its end");
}

void World::Implementation::restoreMembers(std::span<const std::uint8_t>& in) {
  demand(taken<int>(in) == dSpaceGetNumGeoms(space));
  std::vector<dGeomID> order;
  std::vector<bool> moved;
  for (int i = 0; i < dSpaceGetNumGeoms(space); ++i) {
    const int number = taken<int>(in);
    const dGeomID geom = memberGeom(number);
    demand(geom != nullptr && std::ranges::count(order, geom) == 0);
    order.push_back(geom);
    if (number == kBallMember) {
      moved.push_back(ball.moved);
    } else if (number >= 0 && number < kFirstFixture) {
      moved.push_back(anyMoved(robot(number)));
    } else {
      moved.push_back(fixturesMoved);
    }
  }
  refillSpace(space, order, moved);
}

int World::Implementation::memberNumber(dGeomID geom) const {
  if (geom == ball.geom) return kBallMember;
  if (geom == reinterpret_cast<dGeomID>(leftGoal)) return kLeftGoalMember;
  if (geom == reinterpret_cast<dGeomID>(rightGoal)) return kRightGoalMember;
  for (const auto& robot : robots) {
    if (geom == reinterpret_cast<dGeomID>(robot->space)) return robot->handle;
  }
  for (std::size_t i = 0; i < fixtures.size(); ++i) {
    if (geom == fixtures[i]) return kFirstFixture + static_cast<int>(i);
  }
  throw std::logic_error("a geom that is not the world's");
}

dGeomID World::Implementation::memberGeom(int number) {
  if (number == kBallMember) return ball.geom;
  if (number == kLeftGoalMember) return reinterpret_cast<dGeomID>(leftGoal);
  if (number == kRightGoalMember) return reinterpret_cast<dGeomID>(rightGoal);
  if (number < kFirstFixture) {
    if (std::ranges::count(handles, number) == 0) return nullptr;
    return reinterpret_cast<dGeomID>(robot(number).space);
  }
  const auto place = static_cast<std::size_t>(number - kFirstFixture);
  return place < fixtures.size() ? fixtures[place] : nullptr;
}

std::uint64_t World::signature() const {
  Hash hash;
  const auto add = [&hash](const dReal* values, std::size_t count) {
    hash.add({reinterpret_cast<const std::uint8_t*>(values), count * sizeof(dReal)});
  };
  const auto addBody = [&add](dBodyID body) {
    add(dBodyGetPosition(body), 3);
    add(dBodyGetQuaternion(body), 4);
    add(dBodyGetLinearVel(body), 3);
    add(dBodyGetAngularVel(body), 3);
  };
  addBody(implementation_->ball.body);
  for (const auto& robot : implementation_->robots) {
    for (const BodyNode& body : robot->bodies) addBody(body.body);
  }
  return hash.value();
}

}  // namespace nonet::sim
