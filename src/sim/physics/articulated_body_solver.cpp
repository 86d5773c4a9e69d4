#include "sim/physics/articulated_body_solver.h"

#include <array>
#include <cmath>

#include <Eigen/Geometry>

#include "sim/physics/ode_parameters.h"
#include "sim/physics/small_cholesky.h"

namespace nonet::sim {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

const Vector3d kGravityVector(0.0, 0.0, -kGravity);

/// Gyroscopic torque, implicit in the step [Lacoursiere 2006], as ODE has it: (I (I - h [L])^-1 - 1) L / h.
Vector3d gyroscopicTorque(const Matrix3d& inertia, const Vector3d& rate, double seconds) {
  const Vector3d momentum = inertia * rate;
  const Matrix3d effective = inertia - seconds * skew(momentum);
  return (inertia * effective.inverse() * momentum - momentum) / seconds;
}

}  // namespace

ArticulatedBodySolver::ArticulatedBodySolver(int robotType) {
  if (robotType < 0) {
    links_.resize(1);
  } else {
    const RobotPlan& plan = robotPlan(robotType);
    for (const RobotPlan::Body& body : plan.bodies) {
      Link link;
      if (body.joint) {
        link.parent = static_cast<int>(body.joint->parent);
        const Vector3d anchor = body.joint->anchor.cast<double>();
        link.childAnchor = anchor - body.pose.position.cast<double>();
        link.parentAnchor = anchor - plan.bodies[body.joint->parent].pose.position.cast<double>();
        link.childAxis = link.parentAxis = body.joint->axis.cast<double>().normalized();
        link.lowStop = body.joint->lowStop;
        link.highStop = body.joint->highStop;
      }
      links_.push_back(link);
    }
  }
  const std::size_t count = links_.size();
  joints_.resize(count);
  inertias_.resize(count);
  articulatedInertias_.resize(count);
  momenta_.resize(count);
  biasImpulses_.resize(count);
  velocities_.resize(count);
  jointImpulses_.resize(count);
}

void ArticulatedBodySolver::setUp(const Mechanism& mechanism, double seconds) {
  compliance_ = kWorldCfm / seconds;
  for (std::size_t i = 0; i < links_.size(); ++i) setUpBody(i, mechanism.bodies[i], seconds);
  for (std::size_t i = 1; i < links_.size(); ++i) setUpJoint(i, mechanism, seconds);
}

void ArticulatedBodySolver::setUpBody(std::size_t i, dBodyID body, double seconds) {
  Link& link = links_[i];
  if (link.mass == 0.0) {
    dMass mass;
    dBodyGetMass(body, &mass);
    link.mass = mass.mass;
    link.inertia.diagonal() << mass.I[0], mass.I[5], mass.I[10];
  }
  const Matrix3d rotation = rotationOf(body);
  const Matrix3d inertia = rotation * link.inertia * rotation.transpose();
  inertias_[i].setZero();
  inertias_[i].diagonal().head<3>().setConstant(link.mass);
  inertias_[i].bottomRightCorner<3, 3>() = inertia;
  const Vector3d rate = vectorOf(dBodyGetAngularVel(body));
  const Vector3d torque = vectorOf(dBodyGetTorque(body)) + gyroscopicTorque(inertia, rate, seconds);
  momenta_[i] << link.mass * vectorOf(dBodyGetLinearVel(body)) +
                     seconds * (vectorOf(dBodyGetForce(body)) + link.mass * kGravityVector),
      inertia * rate + seconds * torque;
}

void ArticulatedBodySolver::setUpJoint(std::size_t i, const Mechanism& mechanism, double seconds) {
  const Link& link = links_[i];
  Joint& joint = joints_[i];
  const dBodyID child = mechanism.bodies[i];
  const dBodyID parent = mechanism.bodies[static_cast<std::size_t>(link.parent)];
  const Matrix3d childRotation = rotationOf(child);
  const Matrix3d parentRotation = rotationOf(parent);
  joint.childArm = childRotation * link.childAnchor;
  joint.parentArm = parentRotation * link.parentAnchor;
  joint.axis = childRotation * link.childAxis;
  const double correction = kWorldErp / seconds;
  joint.target.head<3>() = correction * (joint.parentArm + vectorOf(dBodyGetPosition(parent)) -
                                         joint.childArm - vectorOf(dBodyGetPosition(child)));
  joint.target.tail<3>() = correction * joint.axis.cross(parentRotation * link.parentAxis);
  setUpAxisRow(i, mechanism, seconds);
}

// The motor, or a stop with its bounce (server facts 2.4; dxJointLimitMotor in ODE).
void ArticulatedBodySolver::setUpAxisRow(std::size_t i, const Mechanism& mechanism, double seconds) {
  const Link& link = links_[i];
  Joint& joint = joints_[i];
  const dJointID hinge = mechanism.joints[i - 1];
  const double angle = mechanism.angle(i - 1);
  const double motor = dJointGetHingeParam(hinge, dParamVel);
  joint.row = AxisRow::Constraint;
  joint.axisCompliance = kMotorCfm / seconds;
  double speed = motor;
  joint.low = -kMotorTorque * seconds;
  joint.high = kMotorTorque * seconds;
  const bool atLow = angle <= link.lowStop;
  if (atLow || angle >= link.highStop) {
    const auto parent = static_cast<std::size_t>(link.parent);
    // The motor pushes with its full torque, or hardly at all if it would lead away from the stop.
    double torque = motor > 0.0 || (motor == 0.0 && !atLow) ? -kMotorTorque : kMotorTorque;
    if ((atLow && motor > 0.0) || (!atLow && motor < 0.0)) torque *= kMotorFudgeFactor;
    momenta_[parent].tail<3>() += seconds * torque * joint.axis;
    momenta_[i].tail<3>() -= seconds * torque * joint.axis;
    speed = -kStopErp / seconds * (angle - (atLow ? link.lowStop : link.highStop));
    const double rate = joint.axis.dot(vectorOf(dBodyGetAngularVel(mechanism.bodies[i])) -
                                       vectorOf(dBodyGetAngularVel(mechanism.bodies[parent])));
    if (atLow ? rate < 0.0 && -rate > speed : rate > 0.0 && -rate < speed) speed = -kStopBounce * rate;
    joint.low = atLow ? 0.0 : -HUGE_VAL;
    joint.high = atLow ? HUGE_VAL : 0.0;
  }
  joint.target.tail<3>() += speed * joint.axis;
}

double ArticulatedBodySolver::limitImpulse(const Joint& joint) {
  if (joint.row == AxisRow::Constraint) return 0.0;
  return joint.row == AxisRow::AtLow ? joint.low : joint.high;
}

/// E times an impulse.
Vector6 ArticulatedBodySolver::complianceTimes(const Joint& joint, const Vector6& impulse) const {
  Vector6 result = compliance_ * impulse;
  if (joint.row == AxisRow::Constraint) {
    const double along = joint.axis.dot(impulse.tail<3>());
    result.tail<3>() += (joint.axisCompliance - compliance_) * along * joint.axis;
  }
  return result;
}

// With H the child's articulated-body inertia, E = e + f a a^T and N = (1 + e H)^-1, by the formula of
// Sherman and Morrison:
//     T = (1 + H E)^-1 = N - f N H a (N a)^T / (1 + f a^T N H a),     B = T H.
// Where the joint turns freely, H is taken without the part that moves about the axis.
void ArticulatedBodySolver::computeInertias() {
  articulatedInertias_ = inertias_;
  for (std::size_t i = links_.size(); i-- > 1;) {
    Joint& joint = joints_[i];
    Matrix6 inertia = inertiaSeenFrom(articulatedInertias_[i], skew(joint.childArm));
    joint.axisMomentum = inertia.rightCols<3>() * joint.axis;
    joint.axisInertia = joint.axis.dot(joint.axisMomentum.tail<3>());
    const bool free = joint.row != AxisRow::Constraint;
    if (free) inertia -= joint.axisMomentum * joint.axisMomentum.transpose() / joint.axisInertia;
    Matrix6 middle = compliance_ * inertia;
    middle.diagonal().array() += 1.0;
    joint.transmission = SmallCholesky(middle).inverse();
    if (!free) {
      const double more = joint.axisCompliance - compliance_;
      const Vector6 momentum = joint.transmission * joint.axisMomentum;
      const Vector6 turn = joint.transmission.rightCols<3>() * joint.axis;
      const double share = more / (1.0 + more * joint.axis.dot(momentum.tail<3>()));
      joint.transmission -= share * momentum * turn.transpose();
    }
    joint.apparentInertia = joint.transmission * inertia;
    articulatedInertias_[static_cast<std::size_t>(links_[i].parent)] +=
        inertiaSeenFrom(joint.apparentInertia, -skew(joint.parentArm));
  }
  rootFactors_.compute(articulatedInertias_[0]);
}

/// Momentum of a child (at the anchor) without the part that a free axis takes up.
Vector6 ArticulatedBodySolver::withoutFreeTurn(const Joint& joint, const Vector6& momentum) const {
  if (joint.row == AxisRow::Constraint) return momentum;
  return momentum - joint.axisMomentum * (joint.axis.dot(momentum.tail<3>()) / joint.axisInertia);
}

/// What the momentum of a child turns a free axis by, added to the child's velocity (both at the anchor).
void ArticulatedBodySolver::addFreeTurn(const Joint& joint, const Vector6& momentum, Vector6& velocity) {
  if (joint.row == AxisRow::Constraint) return;
  const double turn =
      (joint.axis.dot(momentum.tail<3>()) - joint.axisMomentum.dot(velocity)) / joint.axisInertia;
  velocity.tail<3>() += turn * joint.axis;
}

/// A child's velocity from its bias impulse and its parent's velocity (all at the centres); also the joint's
/// impulse.
Vector6 ArticulatedBodySolver::childVelocity(const Joint& joint, const Vector6& bias,
                                             const Vector6& parentVelocity, Vector6& impulse) const {
  const double limit = limitImpulse(joint);
  const Vector6 target = joint.target + velocityAt(parentVelocity, joint.parentArm);
  Vector6 momentum = impulseAtEnd(bias, joint.childArm);
  momentum.tail<3>() += limit * joint.axis;
  impulse = joint.apparentInertia * target - joint.transmission * withoutFreeTurn(joint, momentum);
  Vector6 velocity = target - complianceTimes(joint, impulse);
  addFreeTurn(joint, momentum, velocity);
  impulse.tail<3>() += limit * joint.axis;
  return velocityAt(velocity, -joint.childArm);
}

/// The same for six bias impulses at once (null: none), without target velocities and motors.
Matrix6 ArticulatedBodySolver::childResponse(const Joint& joint, const Matrix6* biases,
                                             const Matrix6& parentResponse) const {
  Matrix6 targets;
  for (int k = 0; k < 6; ++k) targets.col(k) = velocityAt(parentResponse.col(k), joint.parentArm);
  Matrix6 impulses = joint.apparentInertia * targets;
  Matrix6 momenta = Matrix6::Zero();
  if (biases != nullptr) {
    Matrix6 transmitted;
    for (int k = 0; k < 6; ++k) {
      momenta.col(k) = impulseAtEnd(biases->col(k), joint.childArm);
      transmitted.col(k) = withoutFreeTurn(joint, momenta.col(k));
    }
    impulses -= joint.transmission * transmitted;
  }
  Matrix6 response;
  for (int k = 0; k < 6; ++k) {
    Vector6 velocity = targets.col(k) - complianceTimes(joint, impulses.col(k));
    addFreeTurn(joint, momenta.col(k), velocity);
    response.col(k) = velocityAt(velocity, -joint.childArm);
  }
  return response;
}

void ArticulatedBodySolver::solve(std::span<const Vector6> impulses) {
  backwardPass(impulses);
  forwardPass();
}

void ArticulatedBodySolver::backwardPass(std::span<const Vector6> impulses) {
  biasImpulses_ = momenta_;
  for (std::size_t i = 0; i < impulses.size(); ++i) biasImpulses_[i] += impulses[i];
  for (std::size_t i = links_.size(); i-- > 1;) {
    const Joint& joint = joints_[i];
    const double limit = limitImpulse(joint);
    Vector6 momentum = impulseAtEnd(biasImpulses_[i], joint.childArm);
    momentum.tail<3>() += limit * joint.axis;
    Vector6 toParent =
        joint.transmission * withoutFreeTurn(joint, momentum) - joint.apparentInertia * joint.target;
    toParent.tail<3>() -= limit * joint.axis;
    biasImpulses_[static_cast<std::size_t>(links_[i].parent)] += impulseOnCentre(toParent, joint.parentArm);
  }
}

void ArticulatedBodySolver::forwardPass() {
  velocities_[0] = rootFactors_.solve(biasImpulses_[0]);
  for (std::size_t i = 1; i < links_.size(); ++i) {
    const Vector6& parentVelocity = velocities_[static_cast<std::size_t>(links_[i].parent)];
    velocities_[i] = childVelocity(joints_[i], biasImpulses_[i], parentVelocity, jointImpulses_[i]);
  }
}

// The backward pass meets only the bodies on the way from the pushed one to the root, the forward pass only
// those from there to the observed one. Both ways are short.
void ArticulatedBodySolver::respond(std::size_t pushed, std::span<const std::size_t> observed,
                                    std::span<Matrix6> response) const {
  constexpr std::size_t kMaxDepth = 12;
  std::array<std::size_t, kMaxDepth> way{};
  std::array<Matrix6, kMaxDepth> biases;  // of the bodies on the way to the root, one column per unit impulse
  std::size_t depth = 0;
  Matrix6 bias = Matrix6::Identity();
  for (std::size_t i = pushed;; i = static_cast<std::size_t>(links_[i].parent)) {
    way[depth] = i;
    biases[depth++] = bias;
    if (i == 0) break;
    const Joint& joint = joints_[i];
    Matrix6 momenta;
    for (int k = 0; k < 6; ++k) {
      momenta.col(k) = withoutFreeTurn(joint, impulseAtEnd(bias.col(k), joint.childArm));
    }
    Matrix6 toParent = joint.transmission * momenta;
    for (int k = 0; k < 6; ++k) toParent.col(k) = impulseOnCentre(toParent.col(k), joint.parentArm);
    bias = toParent;
  }
  const auto biasesOf = [&](std::size_t body) -> const Matrix6* {
    for (std::size_t k = 0; k < depth; ++k) {
      if (way[k] == body) return &biases[k];
    }
    return nullptr;
  };
  const Matrix6 rootResponse = SmallCholesky(rootFactors_).solve(biases[depth - 1]);
  for (std::size_t o = 0; o < observed.size(); ++o) {
    std::array<std::size_t, kMaxDepth> down{};
    std::size_t steps = 0;
    for (std::size_t i = observed[o]; i != 0; i = static_cast<std::size_t>(links_[i].parent)) {
      down[steps++] = i;
    }
    response[o] = rootResponse;
    while (steps > 0) {
      const std::size_t i = down[--steps];
      const Matrix6 ofParent = response[o];
      response[o] = childResponse(joints_[i], biasesOf(i), ofParent);
    }
  }
}

int ArticulatedBodySolver::correctMotors(bool onlyFirst) {
  int wrong = 0;
  for (std::size_t i = 1; i < links_.size(); ++i) {
    Joint& joint = joints_[i];
    AxisRow right = joint.row;
    if (joint.row == AxisRow::Constraint) {
      const double along = joint.axis.dot(jointImpulses_[i].tail<3>());
      if (along < joint.low) right = AxisRow::AtLow;
      if (along > joint.high) right = AxisRow::AtHigh;
    } else {
      const Vector3d turn =
          velocities_[i].tail<3>() - velocities_[static_cast<std::size_t>(links_[i].parent)].tail<3>();
      const double excess = joint.axis.dot(turn) + joint.axisCompliance * limitImpulse(joint) -
                            joint.axis.dot(joint.target.tail<3>());
      if (joint.row == AxisRow::AtLow ? excess < 0.0 : excess > 0.0) right = AxisRow::Constraint;
    }
    if (right == joint.row) continue;
    ++wrong;
    if (onlyFirst && wrong > 1) continue;
    joint.row = right;
  }
  return wrong;
}

}  // namespace nonet::sim
