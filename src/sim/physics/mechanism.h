// The bodies and joints of a robot, or the ball alone, in an ODE world of their own. Robots that touch
// nothing but the ground are stepped apart from each other; those that touch are stepped together, as
// replicas in a common world. Either way ODE sees the same bodies, joints and contacts in the same order as
// in one world for all, so the results are the same bits.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <ode/ode.h>
#include <ode/threading_impl.h>

#include "nonet/sim/physics/world.h"

namespace nonet::sim {

/// A robot as its scene description computes it: in the birthplace, all joints 0. 32-bit, server axes.
struct RobotPlan {
  struct Joint {
    model::JointId id = model::JointId::Head1;
    std::size_t parent = 0;  // index of the parent's body
    Vector3f anchor;         // world
    Vector3f axis;           // world
    float lowStop = 0.0F;    // rad
    float highStop = 0.0F;
    float maxSpeed = 0.0F;  // rad/s
  };
  struct Body {
    model::BodyId id = model::BodyId::Torso;
    model::ShapeKind shape = model::ShapeKind::Box;
    Vector3f size;  // Box: extents; Sphere: x = radius; Capsule: x = radius, y = cylinder length
    float mass = 0.0F;
    bool collider = false;
    ScenePose pose;
    std::optional<Joint> joint;  // to its parent
  };
  std::vector<Body> bodies;  // in creation order
};

const RobotPlan& robotPlan(int type);

struct Mechanism {
  std::vector<dBodyID> bodies;   // in creation order
  std::vector<dJointID> joints;  // likewise

  /// Angle of a joint (its index), rad. Computed once between two moves: sensors, motors and stepper ask.
  double angle(std::size_t joint) const;
  /// To be called when a body has been turned.
  void turned() { ++turns; }

  struct KnownAngle {
    double angle = 0.0;
    std::uint64_t turns = 0;
  };
  mutable std::vector<KnownAngle> knownAngles;
  std::uint64_t turns = 1;
};

/// An ODE world with the server's parameters (server facts 3.1), and the group of its contact joints. It may
/// be stepped while other threads step others: ODE's default threading object, shared by all worlds, does not
/// allow that, so each has its own.
class OdeWorld {
 public:
  OdeWorld();
  ~OdeWorld();
  OdeWorld(const OdeWorld&) = delete;
  OdeWorld& operator=(const OdeWorld&) = delete;

  dWorldID id() const { return world_; }
  dJointGroupID contactJoints() const { return contactJoints_; }

 private:
  dWorldID world_;
  dJointGroupID contactJoints_;
  dThreadingImplementationID threading_;
};

Mechanism buildMechanism(dWorldID world, const RobotPlan& plan);
Mechanism buildBall(dWorldID world, float radius, float mass);

/// copyBody() for every body, and the motor speeds of the joints. Sleep (enabled or not, the countdown) is
/// the caller's business.
void copyState(const Mechanism& from, const Mechanism& to);

/// Writes pose, velocities, force and torque bit by bit, without ODE's normalisation of quaternion and
/// matrix.
void copyBody(dBodyID from, dBodyID to);

}  // namespace nonet::sim
