// One cycle of the physics: drag and sensor sampling, collision, ODE's step, poses back to the scene.
#include <algorithm>

#include "sim/physics/containment.h"
#include "sim/physics/ode_parameters.h"
#include "sim/physics/scene.h"
#include "sim/physics/world_implementation.h"

namespace nonet::sim {

namespace {

constexpr float kLinearDrag = 0.01F;
constexpr float kRobotAngularDrag = 0.01F;
constexpr float kBallAngularDrag = 0.00005F;
const Vector3f kGravityVector{0.0F, 0.0F, -kGravity};

Vector3f resistance(const Vector3f& velocity, float drag) {
  return (velocity * drag) * -1.0F;
}

// Server facts 2.5.
void applyDrag(dBodyID body, float angularDrag) {
  const Vector3f force = resistance(scene::fromOde(dBodyGetLinearVel(body)), kLinearDrag);
  dBodyAddForce(body, force.x(), force.y(), force.z());
  const Vector3f torque = resistance(scene::fromOde(dBodyGetAngularVel(body)), angularDrag);
  dBodyAddTorque(body, torque.x(), torque.y(), torque.z());
}

// Server facts 2.6, accelerometer.
void sampleAcceleration(RobotNode& robot) {
  const dBodyID torso = robot.bodies.front().body;
  const Vector3f velocity = scene::fromOde(dBodyGetLinearVel(torso));
  const Vector3f change = (velocity - robot.lastVelocity) / kServerCycleTime - kGravityVector;
  robot.lastVelocity = velocity;
  robot.acceleration = scene::inverseDirection(scene::rotationFromOde(dBodyGetRotation(torso)), change);
}

// Server facts 3.2: the mean where both sides define a property, else the value of the one that does.
float mixed(bool first, float a, bool second, float b) {
  if (first && second) return (a + b) / 2.0F;
  return first ? a : b;
}

void mixSurfaces(const Surface& a, const Surface& b, dSurfaceParameters& surface) {
  surface.mode = 0;
  surface.mu = dInfinity;
  if (a.softCfm || b.softCfm) {
    surface.soft_cfm = mixed(a.softCfm, a.cfm, b.softCfm, b.cfm);
    surface.mode |= dContactSoftCFM;
  }
  if (a.softErp || b.softErp) {
    surface.soft_erp = mixed(a.softErp, a.erp, b.softErp, b.erp);
    surface.mode |= dContactSoftERP;
  }
  if (a.bounces || b.bounces) {
    surface.bounce = mixed(a.bounces, a.bounce, b.bounces, b.bounce);
    surface.bounce_vel = mixed(a.bounces, a.bounceVelocity, b.bounces, b.bounceVelocity);
    surface.mode |= dContactBounce;
  }
  if (a.slips || b.slips) {
    surface.slip1 = mixed(a.slips, a.slip, b.slips, b.slip);
    surface.slip2 = surface.slip1;
    surface.mode |= dContactSlip1 | dContactSlip2;
  }
}

bool involves(const ContactPair& pair, ContactParty::Kind kind) {
  return pair.first.kind == kind || pair.second.kind == kind;
}

void stepIsland(Island& island, WorldSettings::Solver solver) {
  rememberPoses(island);
  if (solver == WorldSettings::Solver::Exact) {
    stepExactly(island, kServerCycleTime);
  } else {
    stepQuickly(island, kServerCycleTime);
  }
  contain(island);
}

}  // namespace

// The server walks its scene tree: ball, then robot by robot, and in a robot the torso with its effectors and
// sensors before the other bodies.
void World::Implementation::prePhysics() {
  applyDrag(ball.body, kBallAngularDrag);
  for (const auto& robot : robots) {
    applyDrag(robot->bodies.front().body, kRobotAngularDrag);
    runDeferred(*robot, DeferredBy::Init);
    sampleAcceleration(*robot);
    runDeferred(*robot, DeferredBy::Beam);
    for (std::size_t i = 1; i < robot->bodies.size(); ++i) {
      applyDrag(robot->bodies[i].body, kRobotAngularDrag);
    }
    robot->deferred.reset();
    for (FootSensor& foot : robot->feet) foot.touches.clear();
  }
}

void World::Implementation::collideGeoms(dGeomID first, dGeomID second) {
  if (dGeomIsSpace(first) != 0 || dGeomIsSpace(second) != 0) {
    // The spaces inside are goals (fixed parts only) and robots (parts of one robot do not collide): nothing
    // to do within them.
    dSpaceCollide2(first, second, this, [](void* self, dGeomID a, dGeomID b) {
      static_cast<Implementation*>(self)->collideGeoms(a, b);
    });
    return;
  }
  const auto& firstCollider = *static_cast<const Collider*>(dGeomGetData(first));
  const auto& secondCollider = *static_cast<const Collider*>(dGeomGetData(second));
  if (firstCollider.node == nullptr && secondCollider.node == nullptr) return;
  const int count = dCollide(first, second, static_cast<int>(contactBuffer.size()), &contactBuffer[0].geom,
                             sizeof(dContact));
  if (count > 0) addContacts(firstCollider, secondCollider, count);
}

void World::Implementation::addContacts(const Collider& first, const Collider& second, int count) {
  ContactPair pair{first.party, second.party, count, Vector3f::Zero()};
  for (int i = 0; i < count; ++i) pair.meanPosition += scene::fromOde(contactBuffer[i].geom.pos);
  pair.meanPosition /= static_cast<float>(count);
  const Goal trigger = first.trigger != Goal::None ? first.trigger : second.trigger;
  if (trigger != Goal::None) {
    if (involves(pair, ContactParty::Kind::Ball)) ballInGoal = trigger;
    return;
  }
  contacts.push_back(pair);
  for (int i = 0; i < count; ++i) {
    dContact& contact = contactBuffer[i];
    mixSurfaces(*first.surface, *second.surface, contact.surface);
    if (pendingUsed == pendingContacts.size()) pendingContacts.emplace_back();
    PendingContact& pending = pendingContacts[pendingUsed++];
    pending = {contact, &first, &second, nullptr};
    if (first.footSensor < 0) continue;
    // Server facts 2.6: only the first geom of a pair hears about the force.
    if (feedbackUsed == feedback.size()) feedback.emplace_back();
    dJointFeedback& result = feedback[feedbackUsed++];
    result = dJointFeedback{};
    pending.feedback = &result;
    robot(first.party.robot)
        .feet[static_cast<std::size_t>(first.footSensor)]
        .touches.push_back({scene::fromOde(contact.geom.pos), &result});
  }
}

void World::Implementation::stepPhysics(const SharedWork& alongside) {
  contacts.clear();
  ballInGoal = Goal::None;
  pendingUsed = 0;
  feedbackUsed = 0;
  dSpaceCollide(space, this, [](void* self, dGeomID a, dGeomID b) {
    static_cast<Implementation*>(self)->collideGeoms(a, b);
  });
  formIslands();
  listBySize();
  workers.run(islandsUsed + alongside.count, [this, &alongside](std::size_t i) {
    if (i >= islandsUsed) {
      alongside.piece(i - islandsUsed);
    } else {
      stepIsland(*islandsBySize[i], settings.solver);
    }
  });
  placeMovedGeoms();
  copyPoses();
  for (const auto& robot : robots) readFootSensors(*robot);
  ++cycles;
}

// ODE's rule for idle bodies, kept beside it: a body that is attached to something counts down while both its
// speeds are below 0.01, and starts again otherwise.
void World::Implementation::followSleep(BodyNode& node, bool attached) const {
  constexpr dReal kThreshold = dReal(0.01) * dReal(0.01);
  node.stepsBefore = node.stepsUntilSleep;
  if (!attached || dBodyIsEnabled(node.body) == 0) return;
  const dReal* v = dBodyGetLinearVel(node.body);
  const dReal* w = dBodyGetAngularVel(node.body);
  const bool idle = v[0] * v[0] + v[1] * v[1] + v[2] * v[2] <= kThreshold &&
                    w[0] * w[0] + w[1] * w[1] + w[2] * w[2] <= kThreshold;
  node.stepsUntilSleep = idle ? std::max(0, node.stepsUntilSleep - 1) : kStepsUntilSleep;
}

// Contacts join robots and ball to islands (union-find; the first member of an island leads it).
void World::Implementation::formIslands() {
  multibodies.assign(1, &ballMultibody);
  for (const auto& robot : robots) multibodies.push_back(&robot->multibody);
  leaders.resize(multibodies.size());
  for (std::size_t i = 0; i < multibodies.size(); ++i) {
    multibodies[i]->rank = i;
    leaders[i] = i;
  }
  const auto leaderOf = [this](std::size_t i) {
    while (leaders[i] != i) i = leaders[i];
    return i;
  };
  bool ballTouches = false;
  for (std::size_t i = 0; i < pendingUsed; ++i) {
    const Multibody* first = pendingContacts[i].first->multibody;
    const Multibody* second = pendingContacts[i].second->multibody;
    ballTouches = ballTouches || first == &ballMultibody || second == &ballMultibody;
    if (first == nullptr || second == nullptr) continue;
    const std::size_t a = leaderOf(first->rank);
    const std::size_t b = leaderOf(second->rank);
    leaders[std::max(a, b)] = std::min(a, b);
  }
  followSleep(ball, ballTouches);
  for (const auto& robot : robots) {
    for (BodyNode& body : robot->bodies) followSleep(body, true);
  }
  islandsUsed = 0;
  for (Multibody* multibody : multibodies) {
    const std::size_t leader = leaderOf(multibody->rank);
    if (leader == multibody->rank) {
      if (islandsUsed == islands.size()) islands.emplace_back();
      Island& fresh = islands[islandsUsed++];
      fresh.members.clear();
      fresh.contacts.clear();
      fresh.moved.clear();
      fresh.common = nullptr;
      multibody->island = &fresh;
    } else {
      multibody->island = multibodies[leader]->island;
    }
    multibody->place = multibody->island->members.size();
    multibody->island->members.push_back(multibody);
  }
  for (std::size_t i = 0; i < pendingUsed; ++i) {
    PendingContact& pending = pendingContacts[i];
    const Multibody* multibody =
        pending.first->multibody != nullptr ? pending.first->multibody : pending.second->multibody;
    multibody->island->contacts.push_back(&pending);
  }
  if (settings.solver != WorldSettings::Solver::Exact) return;
  for (std::size_t i = 0; i < islandsUsed; ++i) {
    Island& island = islands[i];
    if (island.members.size() > 1) island.common = &commonWorlds.forMembers(island.members, settings, cycles);
  }
}

// The work of an island grows with the cube of its constraints: begun last, the largest one would keep the
// other threads waiting.
void World::Implementation::listBySize() {
  islandsBySize.clear();
  for (std::size_t i = 0; i < islandsUsed; ++i) islandsBySize.push_back(&islands[i]);
  std::sort(islandsBySize.begin(), islandsBySize.end(), [](const Island* a, const Island* b) {
    if (a->members.size() != b->members.size()) return a->members.size() > b->members.size();
    return a->contacts.size() > b->contacts.size();
  });
}

// In one ODE world for all, the newest bodies would come first, island by island. The order of these moves
// is the order in which the next collision finds the contacts.
void World::Implementation::placeMovedGeoms() {
  fixturesMoved = false;
  ball.moved = false;
  for (const auto& robot : robots) {
    for (BodyNode& body : robot->bodies) body.moved = false;
  }
  movedIslands.clear();
  for (std::size_t i = 0; i < islandsUsed; ++i) {
    if (!islands[i].moved.empty()) movedIslands.push_back(&islands[i]);
  }
  std::sort(movedIslands.begin(), movedIslands.end(), [](const Island* a, const Island* b) {
    return a->moved.front()->collider.multibody->rank > b->moved.front()->collider.multibody->rank;
  });
  for (const Island* island : movedIslands) {
    for (BodyNode* node : island->moved) placeGeom(*node);
  }
}

void World::Implementation::copyPoses() {
  copyPose(ball);
  for (const auto& robot : robots) {
    for (BodyNode& body : robot->bodies) copyPose(body);
  }
}

// Server facts 2.6, FRP. The newest contact is summed first.
void World::Implementation::readFootSensors(RobotNode& robot) {
  for (FootSensor& foot : robot.feet) {
    foot.inContact = !foot.touches.empty();
    if (!foot.inContact) {
      foot.last = FootContact{};
      continue;
    }
    Vector3f force = Vector3f::Zero();
    Vector3f center = Vector3f::Zero();
    float sum = 0.0F;
    for (auto touch = foot.touches.rbegin(); touch != foot.touches.rend(); ++touch) {
      const Vector3f part = scene::fromOde(touch->feedback->f1);
      const float size = scene::length(part);
      force += part;
      center += touch->position * size;
      sum += size;
    }
    if (sum == 0.0F) continue;  // asleep: what was last reported is reported again
    const ScenePose& pose = robot.body(foot.body).pose;
    foot.last.center = scene::inverseTransform(pose, center / sum);
    foot.last.force = scene::inverseRotate(pose.rotation, force);
  }
}

}  // namespace nonet::sim
