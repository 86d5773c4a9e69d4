// Saving and restoring a world, bit by bit. Robots are built anew in their order of creation, then get their
// state. ODE gives no setters for some of it:
//  - quaternion and rotation matrix are written through the pointers ODE hands out (its setters normalise);
//  - the steps left until auto-disable are followed here beside ODE (readSleep) and set by way of
//  dBodyEnable;
//  - the order of the geoms in their spaces, which decides the order of the contacts, and which of them ODE
//    holds for moved, is rebuilt by removing and adding them.
#include <cstring>
#include <stdexcept>
#include <type_traits>

#include "sim/physics/world_implementation.h"

namespace nonet::sim {

namespace {

constexpr std::uint32_t kFormat = 0x4E575231;  // "NWR1"

class Writer {
 public:
  template <typename T>
  void put(const T& value) {
    static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(&value);
    data_.insert(data_.end(), bytes, bytes + sizeof(T));
  }
  template <typename T>
  void put(const T* values, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) put(values[i]);
  }
  void put(const Vector3f& v) { put(v.data(), 3); }
  void put(const ScenePose& pose) {
    put(pose.rotation.data(), 9);
    put(pose.position);
  }
  void put(const ContactParty& party) {
    put(party.kind);
    put(party.robot);
    put(party.body);
  }
  std::vector<std::uint8_t> take() { return std::move(data_); }

 private:
  std::vector<std::uint8_t> data_;
};

class Reader {
 public:
  explicit Reader(std::span<const std::uint8_t> data) : data_(data) {}
  template <typename T>
  T get() {
    if (data_.size() < sizeof(T)) throw std::runtime_error("saved world: cut off");
    T value;
    std::memcpy(&value, data_.data(), sizeof(T));
    data_ = data_.subspan(sizeof(T));
    return value;
  }
  template <typename T>
  void get(T* values, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) values[i] = get<T>();
  }
  Vector3f vector() {
    Vector3f v;
    get(v.data(), 3);
    return v;
  }
  ScenePose pose() {
    ScenePose pose;
    get(pose.rotation.data(), 9);
    pose.position = vector();
    return pose;
  }
  ContactParty party() {
    ContactParty party;
    party.kind = get<ContactParty::Kind>();
    party.robot = get<RobotHandle>();
    party.body = get<model::BodyId>();
    return party;
  }
  bool atEnd() const { return data_.empty(); }

 private:
  std::span<const std::uint8_t> data_;
};

void saveBody(Writer& out, const BodyNode& node) {
  const dBodyID body = node.body;
  out.put(dBodyGetPosition(body), 3);
  out.put(dBodyGetQuaternion(body), 4);
  out.put(dBodyGetRotation(body), 12);
  out.put(dBodyGetLinearVel(body), 3);
  out.put(dBodyGetAngularVel(body), 3);
  out.put(dBodyGetForce(body), 3);
  out.put(dBodyGetTorque(body), 3);
  out.put(dBodyIsEnabled(body) != 0);
  out.put(node.stepsUntilSleep);
  out.put(node.moved);
  out.put(node.pose);
}

void restoreBody(Reader& in, BodyNode& node) {
  const dBodyID body = node.body;
  dReal v[4];
  in.get(v, 3);
  dBodySetPosition(body, v[0], v[1], v[2]);
  in.get(const_cast<dReal*>(dBodyGetQuaternion(body)), 4);
  in.get(const_cast<dReal*>(dBodyGetRotation(body)), 12);
  in.get(v, 3);
  dBodySetLinearVel(body, v[0], v[1], v[2]);
  in.get(v, 3);
  dBodySetAngularVel(body, v[0], v[1], v[2]);
  in.get(v, 3);
  dBodySetForce(body, v[0], v[1], v[2]);
  in.get(v, 3);
  dBodySetTorque(body, v[0], v[1], v[2]);
  const bool enabled = in.get<bool>();
  setCountdown(node, in.get<int>());
  if (!enabled) dBodyDisable(body);
  const bool moved = in.get<bool>();
  placeGeom(node);
  node.moved = moved;
  node.pose = in.pose();
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

void saveRobot(Writer& out, const RobotNode& robot) {
  out.put(robot.handle);
  out.put(robot.type);
  for (const BodyNode& body : robot.bodies) saveBody(out, body);
  for (const JointNode& joint : robot.joints) {
    out.put(dJointGetHingeParam(joint.joint, dParamVel));
    out.put(joint.frozen);
  }
  out.put(robot.lastVelocity);
  out.put(robot.acceleration);
  for (const FootSensor& foot : robot.feet) {
    out.put(foot.inContact);
    out.put(foot.last.center);
    out.put(foot.last.force);
  }
  const int geoms = dSpaceGetNumGeoms(robot.space);
  out.put(geoms);
  for (int i = 0; i < geoms; ++i) {
    out.put(static_cast<const Collider*>(dGeomGetData(dSpaceGetGeom(robot.space, i)))->party.body);
  }
}

void restoreRobot(Reader& in, RobotNode& robot) {
  for (BodyNode& body : robot.bodies) restoreBody(in, body);
  for (JointNode& joint : robot.joints) {
    dJointSetHingeParam(joint.joint, dParamVel, in.get<dReal>());
    joint.frozen = in.get<bool>();
  }
  robot.lastVelocity = in.vector();
  robot.acceleration = in.vector();
  for (FootSensor& foot : robot.feet) {
    foot.inContact = in.get<bool>();
    foot.last.center = in.vector();
    foot.last.force = in.vector();
  }
  std::vector<dGeomID> order(static_cast<std::size_t>(in.get<int>()));
  std::vector<bool> moved(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const BodyNode& body = robot.body(in.get<model::BodyId>());
    order[i] = body.geom;
    moved[i] = body.moved;
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
  Writer out;
  out.put(kFormat);
  out.put(cycles);
  out.put(nextHandle);
  out.put(ballInGoal);
  out.put(fixturesMoved);
  saveBody(out, ball);
  out.put(robots.size());
  for (const auto& robot : robots) saveRobot(out, *robot);
  out.put(contacts.size());
  for (const ContactPair& pair : contacts) {
    out.put(pair.first);
    out.put(pair.second);
    out.put(pair.pointCount);
    out.put(pair.meanPosition);
  }
  const int members = dSpaceGetNumGeoms(space);
  out.put(members);
  for (int i = 0; i < members; ++i) out.put(memberNumber(dSpaceGetGeom(space, i)));
  return out.take();
}

void World::Implementation::restore(std::span<const std::uint8_t> state) {
  Reader in(state);
  if (in.get<std::uint32_t>() != kFormat) throw std::runtime_error("saved world: unknown format");
  for (const auto& robot : robots) destroyRobot(*robot);
  robots.clear();
  commonWorlds.clear();
  handles.clear();
  cycles = in.get<std::uint64_t>();
  nextHandle = in.get<RobotHandle>();
  ballInGoal = in.get<Goal>();
  fixturesMoved = in.get<bool>();
  restoreBody(in, ball);
  const auto robotCount = in.get<std::size_t>();
  for (std::size_t i = 0; i < robotCount; ++i) {
    const auto handle = in.get<RobotHandle>();
    addRobotAs(handle, in.get<int>());
    restoreRobot(in, *robots.back());
  }
  contacts.resize(in.get<std::size_t>());
  for (ContactPair& pair : contacts) {
    pair.first = in.party();
    pair.second = in.party();
    pair.pointCount = in.get<int>();
    pair.meanPosition = in.vector();
  }
  std::vector<dGeomID> order(static_cast<std::size_t>(in.get<int>()));
  std::vector<bool> moved(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const int number = in.get<int>();
    order[i] = memberGeom(number);
    moved[i] = fixturesMoved;
    if (number == kBallMember) moved[i] = ball.moved;
    if (number >= 0 && number < kFirstFixture) moved[i] = anyMoved(robot(number));
  }
  refillSpace(space, order, moved);
  if (!in.atEnd()) throw std::runtime_error("saved world: data after its end");
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
  if (number < kFirstFixture) return reinterpret_cast<dGeomID>(robot(number).space);
  return fixtures.at(static_cast<std::size_t>(number - kFirstFixture));
}

std::uint64_t World::signature() const {
  std::uint64_t hash = 14695981039346656037ULL;  // FNV-1a over the bytes of the doubles
  const auto add = [&hash](const dReal* values, int count) {
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(values);
    for (std::size_t i = 0; i < count * sizeof(dReal); ++i) {
      hash ^= bytes[i];
      hash *= 1099511628211ULL;
    }
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
  return hash;
}

}  // namespace nonet::sim
