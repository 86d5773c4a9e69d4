#include "sim/physics/tree.h"

#include <array>
#include <cmath>

#include <Eigen/Geometry>

namespace nonet::sim {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kErp = 0.2;   // ODE's default
const double kCfm = 0.00001F;  // server facts 3.1
const double kMotorCfm = 1e-8F;
const double kMotorForce = 10.0F;
const double kStopErp = 0.8F;
const double kFudge = 1e-5F;
const Vector3d kGravityVector(0.0, 0.0, -9.81F);

Matrix3d cross(const Vector3d& v) {
  Matrix3d matrix;
  matrix << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return matrix;
}

/// The mass matrix seen from a point that moves as v' = v + [offset] w: [1 X; 0 1]^T M [1 X; 0 1].
Matrix6 shifted(const Matrix6& mass, const Matrix3d& offset) {
  const Matrix3d a = mass.topLeftCorner<3, 3>();
  const Matrix3d b = mass.topRightCorner<3, 3>();
  const Matrix3d ax = a * offset;
  Matrix6 result;
  result.topLeftCorner<3, 3>() = a;
  const Matrix3d right = ax + b;
  result.topRightCorner<3, 3>() = right;
  result.bottomLeftCorner<3, 3>() = right.transpose();
  const Matrix3d bx = offset.transpose() * b;
  result.bottomRightCorner<3, 3>() =
      offset.transpose() * ax + bx + bx.transpose() + mass.bottomRightCorner<3, 3>();
  return result;
}

/// Solves X + A X = B for 6 right sides at a time, A symmetric and not negative: with the factors of 1 + A.
/// (Eigen's solver for several right sides is made for large matrices. The roundings are the same as there:
/// panels of four rows.)
class SmallCholesky {
 public:
  explicit SmallCholesky(const Matrix6& matrix) {
    for (int k = 0; k < 6; ++k) {
      double square = 0.0;
      for (int i = 0; i < k; ++i) square += lower_[k][i] * lower_[k][i];
      const double diagonal = std::sqrt(matrix(k, k) - square);
      for (int r = k + 1; r < 6; ++r) {
        double sum = 0.0;
        for (int i = 0; i < k; ++i) sum += lower_[r][i] * lower_[k][i];
        lower_[r][k] = (matrix(r, k) - sum) / diagonal;
      }
      inverse_[k] = 1.0 / diagonal;
    }
  }
  explicit SmallCholesky(const Eigen::LLT<Matrix6>& factors) {
    for (int r = 0; r < 6; ++r) {
      for (int k = 0; k < r; ++k) lower_[r][k] = factors.matrixLLT()(r, k);
      inverse_[r] = 1.0 / factors.matrixLLT()(r, r);
    }
  }

  Matrix6 solve(const Matrix6& right) const {
    Eigen::Matrix<double, 6, 6, Eigen::RowMajor> x = right;
    forward<0, 4>(x);
    for (int r = 4; r < 6; ++r) subtract(x, r, 0, [this, r](int k) { return lower_[r][k]; });
    forward<4, 6>(x);
    backward<2, 6>(x);
    for (int r = 0; r < 2; ++r) subtract(x, r, 2, [this, r](int k) { return lower_[k][r]; });
    backward<0, 2>(x);
    return x;
  }

 private:
  using Rows = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;

  /// Row r minus the sum over four rows from `first` on.
  template <typename Factor>
  static void subtract(Rows& x, int r, int first, const Factor& factor) {
    for (int j = 0; j < 6; ++j) {
      double sum = 0.0;
      for (int k = first; k < first + 4; ++k) sum += factor(k) * x(k, j);
      x(r, j) -= sum;
    }
  }
  template <int Begin, int End>
  void forward(Rows& x) const {
    for (int i = Begin; i < End; ++i) {
      for (int j = 0; j < 6; ++j) x(i, j) *= inverse_[i];
      for (int r = i + 1; r < End; ++r) {
        for (int j = 0; j < 6; ++j) x(r, j) -= x(i, j) * lower_[r][i];
      }
    }
  }
  template <int Begin, int End>
  void backward(Rows& x) const {
    for (int i = End - 1; i >= Begin; --i) {
      for (int j = 0; j < 6; ++j) {
        double sum = 0.0;
        for (int k = i + 1; k < End; ++k) sum += lower_[k][i] * x(k, j);
        x(i, j) = (x(i, j) - sum) * inverse_[i];
      }
    }
  }

  double lower_[6][6] = {};
  double inverse_[6] = {};
};

[[gnu::always_inline]] inline Vector6 atPoint(const Vector6& velocity, const Vector3d& arm) {
  Vector6 result = velocity;
  result.head<3>() += velocity.tail<3>().cross(arm);
  return result;
}

/// An impulse at the end of an arm, as one on the centre.
[[gnu::always_inline]] inline Vector6 atCentre(const Vector6& impulse, const Vector3d& arm) {
  Vector6 result = impulse;
  result.tail<3>() += arm.cross(impulse.head<3>());
  return result;
}

/// An impulse on the centre, as one at the end of an arm.
[[gnu::always_inline]] inline Vector6 fromCentre(const Vector6& impulse, const Vector3d& arm) {
  Vector6 result = impulse;
  result.tail<3>() -= arm.cross(impulse.head<3>());
  return result;
}

Vector3d vectorOf(const dReal* v) {
  return {v[0], v[1], v[2]};
}

Matrix3d rotationOf(dBodyID body) {
  const dReal* r = dBodyGetRotation(body);
  Matrix3d matrix;
  matrix << r[0], r[1], r[2], r[4], r[5], r[6], r[8], r[9], r[10];
  return matrix;
}

/// Gyroscopic torque, implicit in the step [Lacoursiere 2006], as ODE has it: (I (I - h [L])^-1 - 1) L / h.
Vector3d gyroscopicTorque(const Matrix3d& inertia, const Vector3d& rate, double seconds) {
  const Vector3d momentum = inertia * rate;
  const Matrix3d effective = inertia - seconds * cross(momentum);
  return (inertia * effective.inverse() * momentum - momentum) / seconds;
}

}  // namespace

StepTree::StepTree(int robotType) {
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
  masses_.resize(count);
  loaded_.resize(count);
  momenta_.resize(count);
  loads_.resize(count);
  velocity_.resize(count);
  impulse_.resize(count);
}

void StepTree::begin(const Mechanism& mechanism, double seconds) {
  pointCompliance_ = kCfm / seconds;
  for (std::size_t i = 0; i < links_.size(); ++i) beginBody(i, mechanism.bodies[i], seconds);
  for (std::size_t i = 1; i < links_.size(); ++i) beginJoint(i, mechanism, seconds);
}

void StepTree::beginBody(std::size_t i, dBodyID body, double seconds) {
  Link& link = links_[i];
  if (link.mass == 0.0) {
    dMass mass;
    dBodyGetMass(body, &mass);
    link.mass = mass.mass;
    link.inertia.diagonal() << mass.I[0], mass.I[5], mass.I[10];
  }
  const Matrix3d rotation = rotationOf(body);
  const Matrix3d inertia = rotation * link.inertia * rotation.transpose();
  masses_[i].setZero();
  masses_[i].diagonal().head<3>().setConstant(link.mass);
  masses_[i].bottomRightCorner<3, 3>() = inertia;
  const Vector3d rate = vectorOf(dBodyGetAngularVel(body));
  const Vector3d torque = vectorOf(dBodyGetTorque(body)) + gyroscopicTorque(inertia, rate, seconds);
  momenta_[i] << link.mass * vectorOf(dBodyGetLinearVel(body)) +
                     seconds * (vectorOf(dBodyGetForce(body)) + link.mass * kGravityVector),
      inertia * rate + seconds * torque;
}

void StepTree::beginJoint(std::size_t i, const Mechanism& mechanism, double seconds) {
  const Link& link = links_[i];
  Joint& joint = joints_[i];
  const dBodyID child = mechanism.bodies[i];
  const dBodyID parent = mechanism.bodies[static_cast<std::size_t>(link.parent)];
  const Matrix3d childRotation = rotationOf(child);
  const Matrix3d parentRotation = rotationOf(parent);
  joint.childArm = childRotation * link.childAnchor;
  joint.parentArm = parentRotation * link.parentAnchor;
  joint.axis = childRotation * link.childAxis;
  const double correction = kErp / seconds;
  joint.wanted.head<3>() = correction * (joint.parentArm + vectorOf(dBodyGetPosition(parent)) -
                                         joint.childArm - vectorOf(dBodyGetPosition(child)));
  joint.wanted.tail<3>() = correction * joint.axis.cross(parentRotation * link.parentAxis);
  setAxisRow(i, mechanism, seconds);
}

// The motor, or a stop with its bounce (server facts 2.4; dxJointLimitMotor in ODE).
void StepTree::setAxisRow(std::size_t i, const Mechanism& mechanism, double seconds) {
  const Link& link = links_[i];
  Joint& joint = joints_[i];
  const dJointID hinge = mechanism.joints[i - 1];
  const double angle = mechanism.angle(i - 1);
  const double motor = dJointGetHingeParam(hinge, dParamVel);
  joint.row = AxisRow::Constraint;
  joint.axisCompliance = kMotorCfm / seconds;
  double speed = motor;
  joint.low = -kMotorForce * seconds;
  joint.high = kMotorForce * seconds;
  const bool atLow = angle <= link.lowStop;
  if (atLow || angle >= link.highStop) {
    const auto parent = static_cast<std::size_t>(link.parent);
    // The motor pushes with its full force, or hardly at all if it would lead away from the stop.
    double force = motor > 0.0 || (motor == 0.0 && !atLow) ? -kMotorForce : kMotorForce;
    if ((atLow && motor > 0.0) || (!atLow && motor < 0.0)) force *= kFudge;
    momenta_[parent].tail<3>() += seconds * force * joint.axis;
    momenta_[i].tail<3>() -= seconds * force * joint.axis;
    speed = -kStopErp / seconds * (angle - (atLow ? link.lowStop : link.highStop));
    const double rate = joint.axis.dot(vectorOf(dBodyGetAngularVel(mechanism.bodies[i])) -
                                       vectorOf(dBodyGetAngularVel(mechanism.bodies[parent])));
    if (atLow ? rate < 0.0 && -rate > speed : rate > 0.0 && -rate < speed) speed = -rate;  // bounce 1
    joint.low = atLow ? 0.0 : -HUGE_VAL;
    joint.high = atLow ? HUGE_VAL : 0.0;
  }
  joint.wanted.tail<3>() += speed * joint.axis;
}

double StepTree::givenImpulse(const Joint& joint) {
  if (joint.row == AxisRow::Constraint) return 0.0;
  return joint.row == AxisRow::AtLow ? joint.low : joint.high;
}

Vector6 StepTree::compliance(const Joint& joint, const Vector6& impulse) const {
  Vector6 result = pointCompliance_ * impulse;
  if (joint.row == AxisRow::Constraint) {
    const double along = joint.axis.dot(impulse.tail<3>());
    result.tail<3>() += (joint.axisCompliance - pointCompliance_) * along * joint.axis;
  }
  return result;
}

// With H the child's mass at the common point and S S = E: T = (1 + H E)^-1 = 1 - H S (1 + S H S)^-1 S, B = T
// H. A joint whose axis row is a given impulse turns freely: then H without the part that moves about the
// axis.
void StepTree::factor() {
  loaded_ = masses_;
  for (std::size_t i = links_.size(); i-- > 1;) {
    Joint& joint = joints_[i];
    joint.childMass = shifted(loaded_[i], cross(joint.childArm));
    joint.axisMass = joint.childMass.rightCols<3>() * joint.axis;
    joint.axisInertia = joint.axis.dot(joint.axisMass.tail<3>());
    Matrix6 mass = joint.childMass;
    Matrix6 root = Matrix6::Identity() * std::sqrt(pointCompliance_);
    if (joint.row == AxisRow::Constraint) {
      root.bottomRightCorner<3, 3>() += (std::sqrt(joint.axisCompliance) - std::sqrt(pointCompliance_)) *
                                        joint.axis * joint.axis.transpose();
    } else {
      mass -= joint.axisMass * joint.axisMass.transpose() / joint.axisInertia;
    }
    const Matrix6 massRoot = mass * root;
    Matrix6 middle = root * massRoot;
    middle.diagonal().array() += 1.0;
    joint.transmission = -massRoot * SmallCholesky(middle).solve(root);
    joint.transmission.diagonal().array() += 1.0;
    joint.feltMass = joint.transmission * mass;
    loaded_[static_cast<std::size_t>(links_[i].parent)] += shifted(joint.feltMass, -cross(joint.parentArm));
  }
  root_.compute(loaded_[0]);
}

/// Momentum of a child (at the common point) without the part that a free axis takes up.
Vector6 StepTree::freeMomentum(const Joint& joint, const Vector6& momentum) const {
  if (joint.row == AxisRow::Constraint) return momentum;
  return momentum - joint.axisMass * (joint.axis.dot(momentum.tail<3>()) / joint.axisInertia);
}

Vector6 StepTree::passDown(const Joint& joint, const Vector6& wanted, double given, const Vector6& load,
                           const Vector6& parentVelocity, Vector6& impulse) const {
  const Vector6 asked = wanted + atPoint(parentVelocity, joint.parentArm);
  Vector6 momentum = fromCentre(load, joint.childArm);
  momentum.tail<3>() += given * joint.axis;
  impulse = joint.feltMass * asked - joint.transmission * freeMomentum(joint, momentum);
  Vector6 velocity = asked - compliance(joint, impulse);
  if (joint.row != AxisRow::Constraint) {
    const double turn =
        (joint.axis.dot(momentum.tail<3>()) - joint.axisMass.dot(velocity)) / joint.axisInertia;
    velocity.tail<3>() += turn * joint.axis;
  }
  impulse.tail<3>() += given * joint.axis;
  return atPoint(velocity, -joint.childArm);
}

/// The same for six loads (null: none) and nothing else.
Matrix6 StepTree::passDown(const Joint& joint, const Matrix6* loads, const Matrix6& parentVelocities) const {
  Matrix6 asked;
  for (int k = 0; k < 6; ++k) asked.col(k) = atPoint(parentVelocities.col(k), joint.parentArm);
  Matrix6 impulses = joint.feltMass * asked;
  Matrix6 momenta = Matrix6::Zero();
  if (loads != nullptr) {
    Matrix6 free;
    for (int k = 0; k < 6; ++k) {
      momenta.col(k) = fromCentre(loads->col(k), joint.childArm);
      free.col(k) = freeMomentum(joint, momenta.col(k));
    }
    impulses -= joint.transmission * free;
  }
  Matrix6 velocities;
  for (int k = 0; k < 6; ++k) {
    Vector6 velocity = asked.col(k) - compliance(joint, impulses.col(k));
    if (joint.row != AxisRow::Constraint) {
      const double turn =
          (joint.axis.dot(momenta.col(k).tail<3>()) - joint.axisMass.dot(velocity)) / joint.axisInertia;
      velocity.tail<3>() += turn * joint.axis;
    }
    velocities.col(k) = atPoint(velocity, -joint.childArm);
  }
  return velocities;
}

void StepTree::solve(std::span<const Vector6> impulses) {
  loads_ = momenta_;
  for (std::size_t i = 0; i < impulses.size(); ++i) loads_[i] += impulses[i];
  for (std::size_t i = links_.size(); i-- > 1;) {
    const Joint& joint = joints_[i];
    Vector6 momentum = fromCentre(loads_[i], joint.childArm);
    const double given = givenImpulse(joint);
    momentum.tail<3>() += given * joint.axis;
    Vector6 up = joint.transmission * freeMomentum(joint, momentum) - joint.feltMass * joint.wanted;
    up.tail<3>() -= given * joint.axis;
    loads_[static_cast<std::size_t>(links_[i].parent)] += atCentre(up, joint.parentArm);
  }
  velocity_[0] = root_.solve(loads_[0]);
  for (std::size_t i = 1; i < links_.size(); ++i) {
    const Joint& joint = joints_[i];
    velocity_[i] = passDown(joint, joint.wanted, givenImpulse(joint), loads_[i],
                            velocity_[static_cast<std::size_t>(links_[i].parent)], impulse_[i]);
  }
}

// Only the bodies on the way from the pushed one to the root carry a load; an observed body's velocity
// follows from the root's along its own way. Both ways are short.
void StepTree::respond(std::size_t pushed, std::span<const std::size_t> observed,
                       std::span<Matrix6> response) const {
  constexpr std::size_t kMaxDepth = 12;
  std::array<std::size_t, kMaxDepth> way{};
  std::array<Matrix6, kMaxDepth> loads;  // by column: of the bodies on the way up
  std::size_t depth = 0;
  Matrix6 load = Matrix6::Identity();
  for (std::size_t i = pushed;; i = static_cast<std::size_t>(links_[i].parent)) {
    way[depth] = i;
    loads[depth++] = load;
    if (i == 0) break;
    const Joint& joint = joints_[i];
    Matrix6 momenta;
    for (int k = 0; k < 6; ++k) {
      momenta.col(k) = freeMomentum(joint, fromCentre(load.col(k), joint.childArm));
    }
    Matrix6 up = joint.transmission * momenta;
    for (int k = 0; k < 6; ++k) up.col(k) = atCentre(up.col(k), joint.parentArm);
    load = up;
  }
  const auto loadOf = [&](std::size_t body) -> const Matrix6* {
    for (std::size_t k = 0; k < depth; ++k) {
      if (way[k] == body) return &loads[k];
    }
    return nullptr;
  };
  const Matrix6 rootVelocity = SmallCholesky(root_).solve(loads[depth - 1]);
  for (std::size_t o = 0; o < observed.size(); ++o) {
    std::array<std::size_t, kMaxDepth> down{};
    std::size_t steps = 0;
    for (std::size_t i = observed[o]; i != 0; i = static_cast<std::size_t>(links_[i].parent))
      down[steps++] = i;
    Matrix6 velocity = rootVelocity;
    while (steps > 0) {
      const std::size_t i = down[--steps];
      const Matrix6* own = loadOf(i);
      velocity = passDown(joints_[i], own, velocity);
    }
    response[o] = velocity;
  }
}

int StepTree::correctMotors(bool onlyFirst) {
  int wrong = 0;
  for (std::size_t i = 1; i < links_.size(); ++i) {
    Joint& joint = joints_[i];
    AxisRow right = joint.row;
    if (joint.row == AxisRow::Constraint) {
      const double along = joint.axis.dot(impulse_[i].tail<3>());
      if (along < joint.low) right = AxisRow::AtLow;
      if (along > joint.high) right = AxisRow::AtHigh;
    } else {
      const Vector3d turn =
          velocity_[i].tail<3>() - velocity_[static_cast<std::size_t>(links_[i].parent)].tail<3>();
      const double excess = joint.axis.dot(turn) + joint.axisCompliance * givenImpulse(joint) -
                            joint.axis.dot(joint.wanted.tail<3>());
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
