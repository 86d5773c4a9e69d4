// The equations of motion of one robot for one step, solved along its tree of joints: the heart of the quick
// stepper.
//
// ODE's step asks for the bodies' velocities v and the joints' impulses mu with
//     M v = p + J^T mu,     J v + E mu = c.
// M is the mass matrix, p the momentum after gravity, drag and gyroscopic torque. J has six rows for each
// joint: three keep the anchors of both bodies together, two their axes parallel, the last one is the motor
// about the axis. E = CFM / h is the joints' compliance, c their target velocity (error correction, motor).
//
// ODE solves this with dense matrices, and the motors' limits as a complementarity problem. Here the
// articulated-body algorithm [Featherstone 2008, chapter 7] finds the same answer in time proportional to
// the number of joints. A backward pass, from the leaves to the torso, computes each body's articulated-body
// inertia and bias impulse; a forward pass, from the torso to the leaves, the velocities. Other than in the
// book, bodies have all six degrees of freedom, joints give way by their compliance, and velocities and
// impulses take the place of accelerations and forces. A motor at its limit is no constraint: its joint turns
// freely, and the motor's greatest impulse acts on both bodies.
#pragma once

#include <span>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "sim/physics/mechanism.h"
#include "sim/physics/spatial.h"

namespace nonet::sim {

class ArticulatedBodySolver {
 public:
  /// For a robot of this type, or (-1) the ball, a single body.
  explicit ArticulatedBodySolver(int robotType);

  /// Sets up the equations of a step of `seconds`. All motors are taken to be within their limits.
  void setUp(const Mechanism& mechanism, double seconds);
  /// The backward pass of the inertias; needed after setUp() and after each change of a motor's state.
  void computeInertias();
  /// The backward pass of the bias impulses and the forward pass. `impulses` act on the bodies from outside
  /// (one for each, or none at all).
  void solve(std::span<const Vector6> impulses);

  /// Velocity of a body in the solution.
  const Vector6& velocity(std::size_t body) const { return velocities_[body]; }
  /// How much the velocities of the observed bodies change by unit impulses on `pushed`, all joints
  /// considered: blocks of the inverse inertia in operational space. One matrix per observed body; its
  /// columns belong to the six impulses. Needs computeInertias().
  void respond(std::size_t pushed, std::span<const std::size_t> observed, std::span<Matrix6> response) const;

  /// Looks in the solution for motors beyond their limit, and for motors at their limit that ought to be free
  /// of it, and changes their state: of all of them, or of the first one only. Returns how many there are.
  int correctMotors(bool onlyFirst);

 private:
  /// State of the row about a joint's axis: a constraint, or the impulse of a motor at its limit.
  enum class AxisRow : std::uint8_t { Constraint, AtLow, AtHigh };

  struct Link {  // a body, and the joint to its parent; the root has none
    int parent = -1;
    double mass = 0.0;                                  // kg
    Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  // kg m^2, body axes
    Eigen::Vector3d childAnchor, parentAnchor;          // m, in the axes of the bodies
    Eigen::Vector3d childAxis, parentAxis;
    double lowStop = 0.0;  // rad
    double highStop = 0.0;
  };
  /// Frames: "at the anchor" takes the anchor, the point that both bodies share, for the reference point.
  struct Joint {
    Eigen::Vector3d childArm, parentArm;  // from the bodies' centres to the anchor, m, world axes
    Eigen::Vector3d axis;                 // of the child, world axes
    Vector6 target = Vector6::Zero();     // c: of the child relative to the parent, at the anchor
    double low = 0.0;                     // bounds of the axis row's impulse, N m s
    double high = 0.0;
    double axisCompliance = 0.0;  // E of the axis row
    AxisRow row = AxisRow::Constraint;
    // By computeInertias(), all at the anchor:
    Matrix6 transmission;  // T: the part of a free child's momentum that arrives at the parent
    Matrix6
        apparentInertia;   // B: the child's articulated-body inertia as the parent feels it through the joint
    Vector6 axisMomentum;  // of the child turning about the axis with 1 rad/s
    double axisInertia = 0.0;  // about the axis, kg m^2
  };

  void setUpBody(std::size_t i, dBodyID body, double seconds);
  void setUpJoint(std::size_t i, const Mechanism& mechanism, double seconds);
  void setUpAxisRow(std::size_t i, const Mechanism& mechanism, double seconds);
  void backwardPass(std::span<const Vector6> impulses);
  void forwardPass();
  Vector6 withoutFreeTurn(const Joint& joint, const Vector6& momentum) const;
  static double limitImpulse(const Joint& joint);
  Vector6 complianceTimes(const Joint& joint, const Vector6& impulse) const;
  static void addFreeTurn(const Joint& joint, const Vector6& momentum, Vector6& velocity);
  Vector6 childVelocity(const Joint& joint, const Vector6& bias, const Vector6& parentVelocity,
                        Vector6& impulse) const;
  Matrix6 childResponse(const Joint& joint, const Matrix6* biases, const Matrix6& parentResponse) const;

  std::vector<Link> links_;
  std::vector<Joint> joints_;                 // [i] between body i and its parent; [0] is not used
  std::vector<Matrix6> inertias_;             // of the bodies alone
  std::vector<Matrix6> articulatedInertias_;  // of the bodies with all that hangs on them
  std::vector<Vector6> momenta_;              // p
  // In a solution: the momentum that a body and all that hangs on it bring along. (A bias force times the
  // step is its opposite.)
  std::vector<Vector6> biasImpulses_;
  std::vector<Vector6> velocities_;
  std::vector<Vector6> jointImpulses_;  // mu
  Eigen::LLT<Matrix6> rootFactors_;     // of the root's articulated-body inertia
  double compliance_ = 0.0;             // E of all rows but that about the axis
};

}  // namespace nonet::sim
