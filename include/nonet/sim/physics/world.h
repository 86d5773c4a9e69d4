// The physics world: ODE, the field, the ball and any number of Naos. A library without sockets or rules; any
// number of worlds in one process. Server facts, sections 2 and 3.
//
// Frames and units here are the server's: world x to the right goal, y to the left touch line (seen by the
// left team), z up; body frames x right, y forward, z up. Scene poses and sensor mathematics are 32-bit, as
// in the server; ODE is double precision.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "nonet/math/types.h"
#include "nonet/model/ball.h"
#include "nonet/model/robot_model.h"

namespace nonet::sim {

using Vector3f = Eigen::Vector3f;

/// The length of a cycle as the server has it: 32-bit, s.
inline constexpr float kServerCycleTime = static_cast<float>(kCycleTime);

/// Pose of a body as the scene tree holds it: rotation columns are the body's axes in the world.
struct ScenePose {
  Eigen::Matrix3f rotation = Eigen::Matrix3f::Identity();
  Vector3f position = Vector3f::Zero();
};

/// Robots are named by a handle that is never reused within a world.
using RobotHandle = int;
inline constexpr RobotHandle kNoRobot = -1;

struct WorldSettings {
  /// Exact: ODE's dWorldStep, the real server's bits. Quick: the same equations solved along the robots'
  /// joints (articulated_body_solver.h), three to four times faster; it differs from Exact by rounding (1e-9
  /// m in a step), which only chaos makes visible, after seconds of walking or in a pile of robots.
  enum class Solver : std::uint8_t { Exact, Quick };
  Solver solver = Solver::Exact;
  int threads = 1;  // workers that step separate islands; the result does not depend on it
  /// How long a worker without work looks out for more before it sleeps.
  std::chrono::microseconds threadPatience{0};
  double fieldLength = 30.0;  // m
  double fieldWidth = 20.0;
  double goalWidth = 2.1;
  double goalDepth = 0.6;
  double goalHeight = 0.8;
  double ballRadius = model::kBallRadius;
  double ballMass = 0.026;  // kg
};

/// Who owns a geom that took part in a contact.
struct ContactParty {
  enum class Kind : std::uint8_t { Static, Ball, Robot } kind = Kind::Static;
  RobotHandle robot = kNoRobot;
  model::BodyId body = model::BodyId::Torso;
};

/// One pair of geoms that touched in the last step, with its contact points (1..4).
struct ContactPair {
  ContactParty first;  // as delivered by ODE
  ContactParty second;
  int pointCount = 0;
  Vector3f meanPosition = Vector3f::Zero();  // over its contact points, world, m
};

/// Centre and force of a foot's (toe's) contacts in its own frame (server facts 2.6).
struct FootContact {
  Vector3f center = Vector3f::Zero();  // m
  Vector3f force = Vector3f::Zero();   // N
};

/// Independent pieces of work: piece(0) ... piece(count - 1), each to be called once, by any thread.
struct SharedWork {
  std::size_t count = 0;
  std::function<void(std::size_t)> piece;
};

class World {
 public:
  explicit World(const WorldSettings& settings = {});
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  double time() const;  // s of simulated physics

  // -- robots
  // ---------------------------------------------------------------------------------------------------
  /// Builds a robot with its torso at (0, -1, 1.5), upright, all joints 0, facing +y.
  RobotHandle addRobot(int type);
  void removeRobot(RobotHandle robot);
  std::span<const RobotHandle> robots() const;  // in order of creation
  int robotType(RobotHandle robot) const;

  /// The hinge effector (server facts 2.4): clamps to the joint's speed (32-bit), honours frozen joints, is
  /// ignored at or beyond a stop, wakes the child body if the command is not 0.
  void setJointSpeed(RobotHandle robot, model::JointId joint, float radPerSecond);
  void freezeJoint(RobotHandle robot, model::JointId joint, bool frozen);
  bool isFrozen(RobotHandle robot, model::JointId joint) const;
  float jointAngle(RobotHandle robot, model::JointId joint) const;         // rad
  float jointAngleDegrees(RobotHandle robot, model::JointId joint) const;  // as the perceptor computes it

  // Positions, angles and speeds that are not finite numbers are ignored by all of these, but not by those
  // that set a whole state.

  /// Rigid move: torso to `position`, rotation and joints kept, all velocities 0. Sleeping bodies stay
  /// asleep.
  void moveRobot(RobotHandle robot, const Vector3f& position);
  /// As above, and the torso exactly upright with this yaw in degrees (0 = facing +y).
  void placeRobot(RobotHandle robot, const Vector3f& position, float yawDegrees);

  /// As placeRobot(), but executed within the next prePhysics(), at the place in the walk through the scene
  /// tree where the server runs that effector: the torso's drag (and for Beam its accelerometer) comes before
  /// the move, the drag of the other bodies after it, with velocities 0. Use this for the init and beam
  /// effectors.
  enum class DeferredBy : std::uint8_t { Init, Beam };
  void deferPlacement(RobotHandle robot, DeferredBy effector, const Vector3f& position, float yawDegrees);

  /// The whole mechanical state of a body, in ODE's precision: for starting a world from recorded or computed
  /// poses. The rotation is normalised. Bodies of one robot must fit together at their joints.
  struct BodyState {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero();         // world, m/s
    Eigen::Vector3d angularVelocity = Eigen::Vector3d::Zero();  // world, rad/s
  };
  BodyState bodyState(RobotHandle robot, model::BodyId body) const;
  void setBodyState(RobotHandle robot, model::BodyId body, const BodyState& state);
  /// Puts a robot to sleep or wakes it (ODE's auto-disable, server facts 3.4).
  void setAsleep(RobotHandle robot, bool asleep);
  bool isAsleep(RobotHandle robot) const;

  /// Scene poses after the last step. Moves show only after the next step, as in the server's scene tree.
  const ScenePose& bodyPose(RobotHandle robot, model::BodyId body) const;
  /// Where the body is now, moves included.
  Vector3f bodyPosition(RobotHandle robot, model::BodyId body) const;
  Vector3f bodyVelocity(RobotHandle robot, model::BodyId body) const;  // m/s, world
  Vector3f gyro(RobotHandle robot) const;           // rad/s, torso axes, after the last step
  Vector3f accelerometer(RobotHandle robot) const;  // m/s^2, torso axes, sampled before the last step
  /// Nothing if that foot (or toe) had no contact in the last step.
  std::optional<FootContact> footContact(RobotHandle robot, model::BodyId foot) const;

  // -- ball
  // -----------------------------------------------------------------------------------------------------
  Vector3f ballPosition() const;      // now, moves included
  const ScenePose& ballPose() const;  // scene pose after the last step
  Vector3f ballVelocity() const;
  Vector3f ballAngularVelocity() const;
  void setBallPosition(const Vector3f& position);  // keeps velocity and spin, wakes it
  void setBallVelocity(const Vector3f& velocity);  // stops the spin, wakes it
  void setBallState(const BodyState& state);       // and wakes it
  /// The goal trigger box that the ball overlapped in the last step, if any.
  enum class Goal : std::uint8_t { None, Left, Right };
  Goal ballInGoal() const;

  // -- stepping
  // -------------------------------------------------------------------------------------------------
  /// Drag and sensor sampling (the server's pre-physics phase). Deferred effectors are executed by the caller
  /// right after it.
  void prePhysics();
  /// Collision, one ODE step of kCycleTime, copy of the poses (collide + step + post-physics).
  /// Work that does not touch this world may go on beside the islands, on the same threads.
  void stepPhysics(const SharedWork& alongside = {});
  /// Does work that reads the world, such as the sensors of different robots, on the threads that step the
  /// islands. The first exception of a piece is thrown again here, after the others.
  void share(const SharedWork& work) const;
  /// Contacts of the last step, in the order in which ODE delivered them.
  std::span<const ContactPair> contacts() const;

  // -- state
  // ----------------------------------------------------------------------------------------------------
  /// The full state between two cycles; restoring it into a world with the same settings (this one or
  /// another) continues bit-exactly. Solver and threads may differ: the state does not depend on them.
  /// Placements that are deferred and not executed yet are no part of it.
  std::vector<std::uint8_t> save() const;
  /// Throws std::runtime_error if `state` has another format, length, count or name of a part than a saved
  /// one; the world is then good for nothing but another restore(). Other damage is not noticed.
  void restore(std::span<const std::uint8_t> state);
  /// Hash of all positions and velocities, for determinism checks.
  std::uint64_t signature() const;

  struct Implementation;

 private:
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace nonet::sim
