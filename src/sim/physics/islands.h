// Islands: robots (and the ball) that touch each other are stepped together in a cycle, others apart. And the
// ODE worlds in which that happens.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include <ode/ode.h>

#include "sim/physics/mechanism.h"

namespace nonet::sim {

struct BodyNode;
struct Collider;
struct Island;
struct QuickState;

/// The bodies and joints of a robot, or the ball alone, in an ODE world of their own.
struct Multibody {
  Multibody();
  ~Multibody();
  Multibody(const Multibody&) = delete;
  Multibody& operator=(const Multibody&) = delete;

  OdeWorld world;
  Mechanism mechanism;
  std::vector<BodyNode*> nodes;   // of the mechanism's bodies
  RobotHandle handle = kNoRobot;  // kNoRobot: the ball
  int robotType = -1;
  std::unique_ptr<QuickState> quick;  // for the quick stepper, made when first needed

  // In this cycle:
  std::size_t rank = 0;      // place in the order of creation
  Island* island = nullptr;  // to which it belongs
  std::size_t place = 0;     // among the members of the island
};

/// A contact point, kept until the step.
struct PendingContact {
  dContact contact;
  const Collider* first = nullptr;
  const Collider* second = nullptr;
  dJointFeedback* feedback = nullptr;  // of the foot that hears about it, or null
};

/// A world that holds replicas of several robots (and perhaps the ball).
struct CommonWorld {
  CommonWorld(std::span<Multibody* const> members, const WorldSettings& settings);

  std::vector<RobotHandle> handles;  // of the members
  std::vector<Mechanism> replicas;
  OdeWorld world;
  std::uint64_t lastUse = 0;
};

/// Common worlds are kept for a while: robots that touch often do so for many cycles.
class CommonWorlds {
 public:
  CommonWorld& forMembers(std::span<Multibody* const> members, const WorldSettings& settings,
                          std::uint64_t cycle);
  void forget(RobotHandle handle);
  void clear() { worlds_.clear(); }

 private:
  std::vector<std::unique_ptr<CommonWorld>> worlds_;
};

/// What touches each other, directly or by way of others.
struct Island {
  std::vector<Multibody*> members;        // in order of creation
  std::vector<PendingContact*> contacts;  // in order of creation
  CommonWorld* common = nullptr;          // for more than one member
  std::vector<BodyNode*> stack;           // scratch
  struct Pose {
    std::array<dReal, 3> position{};
    std::array<dReal, 4> quaternion{};
  };
  std::vector<Pose> posesBefore;  // of all bodies of all members, before the step
  std::vector<BodyNode*> moved;   // by the step, in ODE's order
};

/// Has ODE report each body that it moves to the island.
void watchBody(BodyNode& node);

/// Fills `moved` with all bodies in the order in which ODE would step them: from the newest body that is
/// awake along joints and contacts, the newest ones first. For steppers other than ODE's.
void orderAsOde(Island& island);

/// Steps one island with ODE's exact stepper. Nothing is touched but its members.
void stepExactly(Island& island, dReal seconds);

}  // namespace nonet::sim
