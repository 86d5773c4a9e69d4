// The five Nao types as data: one source for the agent's kinematics and for the simulation.
// Frame: the robot's (x forward, y left, z up), all joints at 0; metres, kilograms, radians.
// Source: the server facts, sections 2.1-2.3.
//
// Vectors keep the server's decimal numbers exactly: x here is the server's y, y here the server's -x. So the
// simulation gets back what the server's scene files say (x_server = -y, y_server = x) and can repeat its
// 32-bit arithmetic.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "nonet/math/types.h"
#include "nonet/model/joints.h"

namespace nonet::model {

inline constexpr int kRobotTypeCount = 5;

enum class ShapeKind : std::uint8_t { Box, Sphere, Capsule };

struct Shape {
  ShapeKind kind = ShapeKind::Box;
  Vector3 size = Vector3::Zero();  // Box: full extents. Sphere: x = radius. Capsule (along z): x = radius, y
                                   // = cylinder length.
};

struct BodySpec {
  BodyId id = BodyId::Torso;
  BodyId parent = BodyId::Torso;  // the torso is its own parent
  Shape shape;
  double mass = 0.0;  // kg
  bool collider = false;
  Vector3 offset = Vector3::Zero();   // centre relative to the parent's centre, m
  Vector3 p_RB = Vector3::Zero();     // centre in the torso frame at zero pose, m
  Matrix3 inertia = Matrix3::Zero();  // about the centre, body axes, kg m^2
  std::optional<JointId> joint;       // the joint that carries this body (none for the torso)
};

struct JointSpec {
  JointId id = JointId::Head1;
  BodyId child = BodyId::Torso;
  BodyId parent = BodyId::Torso;
  Vector3 anchor = Vector3::Zero();  // in the child's frame, m
  // At zero pose, in the torso frame. Stored with the server's digits: the hip yaw-pitch axis is
  // (0, 0.7071, +-0.7071), not quite of unit length. forwardKinematics() normalises, the simulation too.
  Vector3 axis = Vector3::UnitX();
  double low = 0.0;       // rad
  double high = 0.0;      // rad
  double maxSpeed = 0.0;  // rad/s
};

class RobotModel {
 public:
  /// `type` 0..4; anything else throws std::out_of_range.
  explicit RobotModel(int type);

  int type() const { return type_; }
  bool hasToes() const { return type_ == 4; }
  /// Bodies in creation order, parents before children.
  std::span<const BodySpec> bodies() const { return bodies_; }
  /// Joints in message order.
  std::span<const JointSpec> joints() const { return joints_; }
  bool has(JointId id) const { return jointIndex_[index(id)] >= 0; }
  bool has(BodyId id) const { return bodyIndex_[index(id)] >= 0; }
  const BodySpec& body(BodyId id) const { return bodies_[bodyIndex_[index(id)]]; }
  const JointSpec& joint(JointId id) const { return joints_[jointIndex_[index(id)]]; }
  double totalMass() const { return totalMass_; }
  /// Torso centre above the sole with straight legs, m.
  double standingHeight() const { return standingHeight_; }

 private:
  int type_;
  std::vector<BodySpec> bodies_;
  std::vector<JointSpec> joints_;
  std::array<int, kBodyCount> bodyIndex_{};
  std::array<int, kJointCount> jointIndex_{};
  double totalMass_ = 0.0;
  double standingHeight_ = 0.0;
};

/// The shared, immutable model of a type (0..4; otherwise std::out_of_range).
const RobotModel& robotModel(int type);

}  // namespace nonet::model
