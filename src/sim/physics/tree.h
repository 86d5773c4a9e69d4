// The equations of one robot's step, solved along its tree of joints: the heart of the quick stepper.
//
// ODE's step asks for velocities v and constraint impulses mu with
//     M v = g + J^T mu,     J v + E mu = c,
// where M is the mass matrix, g the momentum after gravity, drag and gyroscopic torque, J the rows of the
// joints (three for the common point, two for the common axis, one for the motor), E = CFM / h and c the
// speeds that are asked for (error correction, motor). ODE solves this densely, with the motors' limits as a
// complementarity problem. The joints form a tree, so eliminating child bodies from the leaves to the torso
// gives the same answer in time proportional to their number; motors at their limit are taken out as
// constraints and put in as torques. This is the articulated-body recursion [Featherstone 2008, chapter 7] in
// maximal coordinates and with the joints' compliance E.
#pragma once

#include <span>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "sim/physics/mechanism.h"

namespace nonet::sim {

using Vector6 =
    Eigen::Matrix<double, 6, 1>;  // linear (m/s or N s), then angular (rad/s or N m s); world axes
using Matrix6 = Eigen::Matrix<double, 6, 6>;

class StepTree {
 public:
  /// For a robot of this type, or (-1) the ball, a single body.
  explicit StepTree(int robotType);

  /// Sets up the equations of a step of `seconds`. All motors are taken to be within their limits.
  void begin(const Mechanism& mechanism, double seconds);
  /// Eliminates the joints; needed after begin() and after each change of a motor's state.
  void factor();
  /// Solves with additional impulses on the bodies (one for each, or none at all).
  void solve(std::span<const Vector6> impulses);

  std::size_t bodyCount() const { return links_.size(); }
  /// Velocity of a body in the solution.
  const Vector6& velocity(std::size_t body) const { return velocity_[body]; }
  /// How much the velocity of each observed body changes by unit impulses on `pushed`, all joints considered:
  /// one matrix per observed body, its columns are the six impulses. Needs factor().
  void respond(std::size_t pushed, std::span<const std::size_t> observed, std::span<Matrix6> response) const;

  /// Looks in the solution for motors beyond their limit, and for motors at their limit that ought to be free
  /// of it, and changes their state: of all of them, or of the first one only. Returns how many there are.
  int correctMotors(bool onlyFirst);

 private:
  /// State of the row about a joint's axis: a constraint, or a given impulse.
  enum class AxisRow : std::uint8_t { Constraint, AtLow, AtHigh };

  struct Link {  // a body, and the joint to its parent; the root has none
    int parent = -1;
    double mass = 0.0;
    Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  // body axes
    Eigen::Vector3d childAnchor, parentAnchor;          // in the axes of the bodies
    Eigen::Vector3d childAxis, parentAxis;
    double lowStop = 0.0;
    double highStop = 0.0;
  };
  struct Joint {
    Eigen::Vector3d childArm, parentArm;  // from the bodies' centres to the common point, world axes
    Eigen::Vector3d axis;                 // of the child, world axes
    Vector6 wanted = Vector6::Zero();     // c
    double low = 0.0;                     // bounds of the axis row's impulse
    double high = 0.0;
    double axisCompliance = 0.0;  // E of the axis row
    AxisRow row = AxisRow::Constraint;
    // By factor():
    Matrix6 childMass;     // of the child with all that hangs on it, at the common point
    Matrix6 transmission;  // T: the part of a free child's momentum that arrives at the parent
    Matrix6 feltMass;      // B: the child's mass as the parent feels it
    Vector6 axisMass;      // childMass times the axis
    double axisInertia = 0.0;
  };

  void beginBody(std::size_t i, dBodyID body, double seconds);
  void beginJoint(std::size_t i, const Mechanism& mechanism, double seconds);
  void setAxisRow(std::size_t i, const Mechanism& mechanism, double seconds);
  Vector6 freeMomentum(const Joint& joint, const Vector6& momentum) const;
  static double givenImpulse(const Joint& joint);
  Vector6 compliance(const Joint& joint, const Vector6& impulse) const;
  /// Child velocity (at its centre) from its parent's, for a given load; also the joint's impulse.
  Vector6 passDown(const Joint& joint, const Vector6& wanted, double given, const Vector6& load,
                   const Vector6& parentVelocity, Vector6& impulse) const;
  Matrix6 passDown(const Joint& joint, const Matrix6* loads, const Matrix6& parentVelocities) const;

  std::vector<Link> links_;
  std::vector<Joint> joints_;     // [i] between body i and its parent; [0] is not used
  std::vector<Matrix6> masses_;   // own
  std::vector<Matrix6> loaded_;   // own and all that hangs on it
  std::vector<Vector6> momenta_;  // g
  std::vector<Vector6> loads_;    // in a solution: momentum of a body and all that hangs on it
  std::vector<Vector6> velocity_;
  std::vector<Vector6> impulse_;  // mu of each joint in the solution
  Eigen::LLT<Matrix6> root_;
  double pointCompliance_ = 0.0;  // E of the rows of point and axis alignment
};

/// The impulse (linear, angular about the centre) of a force direction acting at an arm from the centre.
inline Vector6 rowAt(const Eigen::Vector3d& arm, const Eigen::Vector3d& direction) {
  Vector6 row;
  row << direction, arm.cross(direction);
  return row;
}

}  // namespace nonet::sim
