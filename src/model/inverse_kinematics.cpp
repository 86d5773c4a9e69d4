#include "nonet/model/inverse_kinematics.h"

#include <algorithm>
#include <cmath>

#include "nonet/math/angle.h"

#include "bounded_fit.h"
#include "limb.h"

namespace nonet::model {

namespace {

constexpr int kShiftSteps = 4;
constexpr double kShiftDamping = 0.02;  // m/rad

JointId firstLegJoint(Side side) {
  return side == Side::Left ? JointId::LLeg1 : JointId::RLeg1;
}

// Direction of a vector in the x-z plane, measured so that a turn about y by an angle adds that angle.
double pitchOf(double x, double z) {
  return std::atan2(x, z);
}

/// What the closed form needs of one leg. All in the plane y = 0 of thigh, shank and ankle.
struct LegGeometry {
  LegGeometry(const RobotModel& model, Side side) {
    const std::size_t first = index(firstLegJoint(side));
    const auto joint = [&](std::size_t number) -> const JointSpec& {
      return model.joint(jointAt(first + number - 1));
    };
    const auto offset = [&](std::size_t number) -> const Vector3& {
      return model.body(joint(number).child).offset;
    };
    for (std::size_t i = 0; i < 6; ++i) {
      low[i] = joint(i + 1).low;
      high[i] = joint(i + 1).high;
    }
    p_RHip = model.body(joint(1).child).p_RB + joint(1).anchor;
    hipAxisRoll = std::atan2(joint(1).axis.z(), joint(1).axis.y());
    kneeToHip = joint(3).anchor - (offset(4) + joint(4).anchor);
    ankleToKnee = joint(4).anchor - (offset(5) + joint(5).anchor);
    ankleAboveRoll = -(offset(6) + joint(6).anchor - joint(5).anchor).z();
    const BodySpec& foot = model.body(joint(6).child);
    rollAboveSole = joint(6).anchor.z() + 0.5 * foot.shape.size.z();
  }

  Vector3 p_RHip;         // where the three hip axes meet
  double hipAxisRoll;     // the yaw-pitch axis is the y axis rolled by this
  Vector3 kneeToHip;      // in the thigh
  Vector3 ankleToKnee;    // in the shank
  double ankleAboveRoll;  // the pitch axis of the ankle lies this much above its roll axis
  double rollAboveSole;
  LegAngles low;
  LegAngles high;
};

/// Distance ankle - hip at a knee angle.
double legLength(const LegGeometry& leg, double knee) {
  const double upper = leg.kneeToHip.norm();
  const double lower = leg.ankleToKnee.norm();
  const double bend = knee + pitchOf(leg.kneeToHip.x(), leg.kneeToHip.z()) -
                      pitchOf(leg.ankleToKnee.x(), leg.ankleToKnee.z());
  return std::sqrt(upper * upper + lower * lower + 2.0 * upper * lower * std::cos(bend));
}

/// Ankle roll, ankle pitch and knee from the place of the hip seen from the foot. A hip that is too far or
/// too near is moved to the nearest place that the knee can reach. That place is found exactly: as long as
/// the foot keeps its orientation, the hip's places lie between two surfaces of revolution about the roll
/// axis.
Reach solveKneeAndAnkle(const LegGeometry& leg, const Vector3& p_SHip, LegAngles& angles) {
  // The roll stays within a quarter turn. So the hip is above the roll axis for the ankle if it is for the
  // foot, and below it likewise (a deep squat with the foot lifted).
  const double hipAboveRoll = p_SHip.z() - leg.rollAboveSole;
  const double side = hipAboveRoll < 0.0 ? -1.0 : 1.0;
  angles[5] = std::atan2(side * p_SHip.y(), side * hipAboveRoll);
  const double x = p_SHip.x();
  const double z = side * std::hypot(p_SHip.y(), hipAboveRoll) - leg.ankleAboveRoll;
  double length = std::hypot(x, z);

  Reach reach = Reach::Exact;
  const double longest = legLength(leg, leg.high[3]);
  const double shortest = legLength(leg, leg.low[3]);
  if (length > longest) {
    if (length > longest + kLengthTolerance) reach = Reach::TooFar;
    length = longest;
    angles[3] = leg.high[3];
  } else if (length < shortest) {
    if (length < shortest - kLengthTolerance) reach = Reach::Limited;
    length = shortest;
    angles[3] = leg.low[3];
  } else {
    const double upper = leg.kneeToHip.norm();
    const double lower = leg.ankleToKnee.norm();
    const double cosine = (length * length - upper * upper - lower * lower) / (2.0 * upper * lower);
    // The knee bends backwards only (its range ends before the leg is straight): one of two solutions.
    const double bend = -std::acos(std::clamp(cosine, -1.0, 1.0));
    angles[3] = bend - pitchOf(leg.kneeToHip.x(), leg.kneeToHip.z()) +
                pitchOf(leg.ankleToKnee.x(), leg.ankleToKnee.z());
  }
  // Ankle to hip in the shank; the pitch axes point to the right, so q4 turns by Ry(-q4) and back by Ry(q4).
  const double c = std::cos(angles[3]);
  const double s = std::sin(angles[3]);
  const double xShank = leg.ankleToKnee.x() + c * leg.kneeToHip.x() + s * leg.kneeToHip.z();
  const double zShank = leg.ankleToKnee.z() - s * leg.kneeToHip.x() + c * leg.kneeToHip.z();
  angles[4] = wrapAngle(pitchOf(x, z) - pitchOf(xShank, zShank));
  return reach;
}

/// Hip angles from the thigh's orientation: R_RThigh = Rx(a) Ry(q1) Rx(q2 - a) Ry(-q3), a = hipAxisRoll.
void solveHip(const LegGeometry& leg, const Matrix3& R_RThigh, LegAngles& angles) {
  const Matrix3 m = Eigen::AngleAxisd(-leg.hipAxisRoll, Vector3::UnitX()).toRotationMatrix() * R_RThigh;
  // q2 - a is always on one side of 0 within the limits, so the sign of its sine is known.
  const double sign = leg.hipAxisRoll > 0.0 ? -1.0 : 1.0;
  const double sine = sign * std::hypot(m(0, 1), m(2, 1));
  angles[0] = std::atan2(sign * m(0, 1), sign * m(2, 1));
  angles[1] = wrapAngle(std::atan2(sine, m(1, 1)) + leg.hipAxisRoll);
  angles[2] = -std::atan2(sign * m(1, 0), -sign * m(1, 2));
}

/// Puts angles into their limits; false if one was really outside.
template <std::size_t N>
bool clampAngles(const std::array<double, N>& low, const std::array<double, N>& high,
                 std::array<double, N>& angles) {
  bool inside = true;
  for (std::size_t i = 0; i < N; ++i) {
    if (angles[i] < low[i] - kAngleTolerance || angles[i] > high[i] + kAngleTolerance) inside = false;
    angles[i] = std::clamp(angles[i], low[i], high[i]);
  }
  return inside;
}

/// From the clamped angles to the nearest pose that the limits allow.
void fitLeg(const RobotModel& model, Side side, const Pose3& X_RS, LegAngles& angles) {
  const Limb<6> limb = legLimb(model, side);
  Eigen::Matrix<double, 6, 1> x = Eigen::Map<const Eigen::Matrix<double, 6, 1>>(angles.data());
  boundedFit<6, 6>([&](const auto& at, auto& residual,
                       auto* derivative) { PoseResidual::evaluate<6>(limb, at, X_RS, residual, derivative); },
                   limb.low(), limb.high(), x, kMaxFitIterations);
  Eigen::Map<Eigen::Matrix<double, 6, 1>>(angles.data()) = x;
}

/// In closed form, within the limits where that is not met; `inside`: they did not bind.
Reach solveLeg(const RobotModel& model, Side side, const Pose3& X_RS, LegAngles& angles, bool& inside) {
  const LegGeometry leg(model, side);
  const Matrix3& R_RS = X_RS.linear();
  const Vector3 p_SHip = R_RS.transpose() * (leg.p_RHip - X_RS.translation());
  const Reach reach = solveKneeAndAnkle(leg, p_SHip, angles);
  // R_RS = R_RThigh Ry(-q4) Ry(-q5) Rx(q6), solved for the thigh.
  const Matrix3 R_SThigh = (Eigen::AngleAxisd(-angles[5], Vector3::UnitX()) *
                            Eigen::AngleAxisd(angles[3] + angles[4], Vector3::UnitY()))
                               .toRotationMatrix();
  solveHip(leg, R_RS * R_SThigh, angles);
  inside = clampAngles(leg.low, leg.high, angles);
  return reach;
}

}  // namespace

Reach legInverseKinematics(const RobotModel& model, Side side, const Pose3& X_RS, LegAngles& angles) {
  bool inside = true;
  const Reach reach = solveLeg(model, side, X_RS, angles, inside);
  // Too far is answered with the foot's orientation kept; too near and all other limits by a fit.
  if (inside && reach != Reach::Limited) return reach;
  fitLeg(model, side, X_RS, angles);
  return reach == Reach::TooFar ? Reach::TooFar : Reach::Limited;
}

bool legReaches(const RobotModel& model, Side side, const Pose3& X_RS, LegAngles& angles) {
  bool inside = true;
  return solveLeg(model, side, X_RS, angles, inside) == Reach::Exact && inside;
}

void shiftSole(const RobotModel& model, Side side, const Vector3& way, double yaw, LegAngles& angles) {
  const Limb<6> limb = legLimb(model, side);
  Eigen::Map<Eigen::Matrix<double, 6, 1>> x(angles.data());
  Pose3 goal = limb.evaluate(x, nullptr);
  goal.translation() += way;
  goal.linear() = Eigen::AngleAxisd(yaw, Vector3::UnitZ()) * goal.linear();
  for (int i = 0; i < kShiftSteps; ++i) {
    Eigen::Matrix<double, 6, 1> residual;
    Eigen::Matrix<double, 6, 6> derivative;
    PoseResidual::evaluate<6>(limb, x, goal, residual, &derivative);
    Eigen::Matrix<double, 6, 6> normal = derivative.transpose() * derivative;
    normal.diagonal().array() += kShiftDamping * kShiftDamping;
    x -= normal.ldlt().solve(derivative.transpose() * residual);
  }
}

void setLegAngles(Side side, const LegAngles& leg, JointArray& joints) {
  std::copy(leg.begin(), leg.end(), joints.begin() + static_cast<std::ptrdiff_t>(index(firstLegJoint(side))));
}

LegAngles legAngles(Side side, const JointArray& joints) {
  LegAngles leg{};
  std::copy_n(joints.begin() + static_cast<std::ptrdiff_t>(index(firstLegJoint(side))), leg.size(),
              leg.begin());
  return leg;
}

}  // namespace nonet::model
