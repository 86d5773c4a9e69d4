// What a World holds: the ODE objects with what the server's scene tree remembers of them.
#pragma once

#include <array>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include <ode/ode.h>

#include "nonet/sim/physics/world.h"

#include "sim/physics/islands.h"
#include "sim/physics/ode_parameters.h"
#include "sim/physics/quick_stepper.h"
#include "sim/physics/scene.h"
#include "sim/physics/workers.h"

namespace nonet::sim {

/// How a collider takes part in contacts (server facts 3.2). Values are 32-bit as in the server.
struct Surface {
  bool contacts = true;  // false: recorded only (goal trigger)
  bool bounces = false;
  bool softErp = false;
  bool softCfm = false;
  bool slips = false;
  float bounce = 0.0F;
  float bounceVelocity = 0.0F;
  float erp = 0.0F;
  float cfm = 0.0F;
  float slip = 0.0F;
};

/// What ODE's geom data points to.
struct Collider {
  ContactParty party;
  BodyNode* node = nullptr;        // null: fixed
  Multibody* multibody = nullptr;  // null: fixed
  const Surface* surface = nullptr;
  World::Goal trigger = World::Goal::None;
  int footSensor = -1;  // index of the robot's foot sensor that hears about contacts of this geom
};

struct BodyNode {
  std::size_t place = 0;  // in its multibody
  model::BodyId id = model::BodyId::Torso;
  dBodyID body = nullptr;
  dGeomID geom = nullptr;             // null: no collider
  std::vector<BodyNode*> neighbours;  // by joints, in the order in which those were attached
  bool visited = false;               // scratch
  ScenePose pose;
  Collider collider;
  int stepsUntilSleep = kStepsUntilSleep;  // ODE's counter, followed here because ODE does not show it
  int stepsBefore = kStepsUntilSleep;      // the same before this step
  bool moved = true;                       // the geom is marked as moved since the last collision
};

/// Wakes the body and starts its countdown to sleep anew.
inline void wakeBody(BodyNode& node) {
  dBodyEnable(node.body);
  node.stepsUntilSleep = kStepsUntilSleep;
}

/// Enables a body with this countdown to sleep, for which ODE has no setter: enabling copies it from a
/// setting.
inline void setOdeCountdown(dBodyID body, int steps) {
  dBodySetAutoDisableSteps(body, steps);
  dBodyEnable(body);
  dBodySetAutoDisableSteps(body, kStepsUntilSleep);
}
inline void setCountdown(BodyNode& node, int steps) {
  setOdeCountdown(node.body, steps);
  node.stepsUntilSleep = steps;
}

/// Puts the geom where the body is. (Geoms are not attached to ODE's bodies: bodies are moved by several
/// threads, geoms by one, in an order that does not depend on them.)
inline void placeGeom(BodyNode& node) {
  node.moved = true;
  node.collider.multibody->mechanism.turned();
  if (node.geom == nullptr) return;
  const dReal* position = dBodyGetPosition(node.body);
  dGeomSetRotation(node.geom, dBodyGetRotation(node.body));
  dGeomSetPosition(node.geom, position[0], position[1], position[2]);
}

/// Takes the body's pose over into the scene.
inline void copyPose(BodyNode& node) {
  node.pose = {scene::rotationFromOde(dBodyGetRotation(node.body)),
               scene::fromOde(dBodyGetPosition(node.body))};
}

struct JointNode {
  model::JointId id = model::JointId::Head1;
  dJointID joint = nullptr;
  dBodyID child = nullptr;
  model::BodyId childId = model::BodyId::Neck;
  float maxSpeed = 0.0F;
  float lowStop = 0.0F;   // rad
  float highStop = 0.0F;  // rad
  bool frozen = false;
};

/// Force resistance perceptor (server facts 2.6).
struct FootSensor {
  struct Touch {
    Vector3f position;
    dJointFeedback* feedback = nullptr;
  };
  model::BodyId body = model::BodyId::RFoot;
  std::vector<Touch> touches;  // of this step, in order of creation
  FootContact last;
  bool inContact = false;
};

struct RobotNode {
  RobotHandle handle = kNoRobot;
  int type = 0;
  dSpaceID space = nullptr;
  Multibody multibody;
  std::vector<BodyNode> bodies;   // in creation order; never resized after building (geoms point into it)
  std::vector<JointNode> joints;  // in creation order
  std::array<int, model::kBodyCount> bodyIndex{};
  std::array<int, model::kJointCount> jointIndex{};
  std::vector<FootSensor> feet;
  struct DeferredPlacement {
    World::DeferredBy effector = World::DeferredBy::Init;
    Vector3f position;
    float yawDegrees = 0.0F;
  };
  std::optional<DeferredPlacement> deferred;  // executed and forgotten in the next prePhysics()
  Vector3f lastVelocity = Vector3f::Zero();
  Vector3f acceleration = Vector3f::Zero();

  BodyNode& body(model::BodyId id) { return bodies[static_cast<std::size_t>(bodyIndex[index(id)])]; }
  const BodyNode& body(model::BodyId id) const {
    return bodies[static_cast<std::size_t>(bodyIndex[index(id)])];
  }
  JointNode* joint(model::JointId id) {
    const int i = jointIndex[index(id)];
    return i < 0 ? nullptr : &joints[static_cast<std::size_t>(i)];
  }
};

struct World::Implementation {
  explicit Implementation(const WorldSettings& settings);
  ~Implementation();
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  // world_build.cpp
  void buildField();
  void buildGoal(Goal side);
  void addBox(dSpaceID space, const ScenePose& pose, const Vector3f& size, const Surface& surface,
              Goal trigger = Goal::None);
  void buildBall();
  RobotHandle addRobot(int type);
  void addRobotAs(RobotHandle handle, int type);
  void removeRobot(RobotHandle handle);
  void destroyRobot(RobotNode& robot);
  RobotNode& robot(RobotHandle handle);

  // world_moves.cpp
  void moveRobot(RobotNode& robot, const Vector3f& position);
  void placeRobot(RobotNode& robot, const Vector3f& position, float yawDegrees);
  void runDeferred(RobotNode& robot, World::DeferredBy effector);

  // world_step.cpp
  void prePhysics();
  void stepPhysics(const SharedWork& alongside);
  void collideGeoms(dGeomID first, dGeomID second);
  void addContacts(const Collider& first, const Collider& second, int count);
  void followSleep(BodyNode& node, bool attached) const;
  void formIslands();
  void listBySize();
  void placeMovedGeoms();
  void copyPoses();
  void readFootSensors(RobotNode& robot);

  // world_state.cpp
  std::vector<std::uint8_t> save() const;
  void restore(std::span<const std::uint8_t> state);
  void restoreMembers(std::span<const std::uint8_t>& in);
  int memberNumber(dGeomID geom) const;
  dGeomID memberGeom(int number);  // null: there is none

  WorldSettings settings;
  dSpaceID space = nullptr;
  dSpaceID leftGoal = nullptr;
  dSpaceID rightGoal = nullptr;
  std::vector<dGeomID> fixtures;  // ground, goals, walls
  std::vector<std::unique_ptr<Collider>> fixtureColliders;
  bool fixturesMoved = true;
  BodyNode ball;
  Multibody ballMultibody;
  std::vector<std::unique_ptr<RobotNode>> robots;  // in order of creation
  std::vector<RobotHandle> handles;                // the same order
  RobotHandle nextHandle = 0;
  std::uint64_t cycles = 0;
  std::vector<ContactPair> contacts;
  Goal ballInGoal = Goal::None;

  // Of the step in progress; kept for their memory.
  StepWorkers workers;
  CommonWorlds commonWorlds;
  std::array<dContact, 4> contactBuffer{};
  std::deque<PendingContact> pendingContacts;  // deques: others keep pointers to the elements during a step
  std::size_t pendingUsed = 0;
  std::deque<dJointFeedback> feedback;
  std::size_t feedbackUsed = 0;
  std::vector<Multibody*> multibodies;  // ball, then robots in order of creation
  std::deque<Island> islands;
  std::size_t islandsUsed = 0;
  std::vector<Island*> islandsBySize;  // those in use, the largest first
  std::vector<Island*> movedIslands;
  std::vector<std::size_t> leaders;  // per multibody: the first multibody of its island
};

}  // namespace nonet::sim
