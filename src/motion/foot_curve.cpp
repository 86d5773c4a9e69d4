#include "nonet/motion/foot_curve.h"

#include <algorithm>
#include <cmath>

#include "nonet/model/inverse_kinematics.h"

namespace nonet::motion {

using model::Side;

Matrix3 rotationOf(const Vector3& rollPitchYaw) {
  return (Eigen::AngleAxisd(rollPitchYaw.z(), Vector3::UnitZ()) *
          Eigen::AngleAxisd(rollPitchYaw.y(), Vector3::UnitY()) *
          Eigen::AngleAxisd(rollPitchYaw.x(), Vector3::UnitX()))
      .toRotationMatrix();
}

Vector3 anglesOf(const Matrix3& rotation) {
  return {std::atan2(rotation(2, 1), rotation(2, 2)), std::asin(std::clamp(-rotation(2, 0), -1.0, 1.0)),
          std::atan2(rotation(1, 0), rotation(0, 0))};
}

FootGoal mirroredGoal(FootGoal goal) {
  goal.side = model::other(goal.side);
  goal.position.y() = -goal.position.y();
  goal.rollPitchYaw.x() = -goal.rollPitchYaw.x();
  goal.rollPitchYaw.z() = -goal.rollPitchYaw.z();
  return goal;
}

void FootCurve::plan(const Instruction& curve, bool mirrored, const Pose3& X_RFrom, const Vector3& origin) {
  side_ = mirrored ? model::other(curve.points[0].side) : curve.points[0].side;
  from_ = X_RFrom.translation();
  attitudes_[0] = anglesOf(X_RFrom.linear());
  count_ = 0;
  for (const FootGoal& raw : curve.points) {
    const FootGoal point = mirrored ? mirroredGoal(raw) : raw;
    points_[count_++] = point.position;
    attitudes_[count_] = point.rollPitchYaw;
  }
  moveTo(origin);
}

void FootCurve::moveTo(const Vector3& origin) {
  origin_ = origin;
  spline_.clear();
  spline_.add(0.0, from_, Vector3::Zero());
  for (std::size_t i = 0; i < count_; ++i) {
    const double share = static_cast<double>(i + 1) / static_cast<double>(count_);
    spline_.add(share, origin + points_[i], Vector3::Zero());
  }
  spline_.smoothInnerKnots();
}

Pose3 FootCurve::at(double share) const {
  const double inWay = std::clamp(share, 0.0, 1.0);
  const auto pieces = static_cast<double>(count_);
  const double s = inWay * pieces;
  const auto i = static_cast<std::size_t>(std::min(s, pieces - 1.0));
  Pose3 X_RS = Pose3::Identity();
  X_RS.translation() = spline_.at(inWay);
  X_RS.linear() =
      rotationOf(attitudes_[i] + (s - static_cast<double>(i)) * (attitudes_[i + 1] - attitudes_[i]));
  return X_RS;
}

double FootCurve::setPace(const model::RobotModel& model, double wanted, const model::JointArray& from,
                          const model::JointArray& to, std::uint32_t moves) {
  double beside = wanted / kSteps;  // s that a step must take for the joints beside the curve
  for (const model::JointSpec& joint : model.joints()) {
    const std::size_t i = model::index(joint.id);
    if (((moves >> i) & 1U) != 0)
      beside = std::max(beside, std::abs(to[i] - from[i]) / joint.maxSpeed / kSteps);
  }
  const std::size_t first = model::index(side_ == Side::Left ? model::JointId::LLeg1 : model::JointId::RLeg1);
  model::LegAngles before = model::legAngles(side_, from);
  times_[0] = 0.0;
  for (std::size_t step = 1; step <= kSteps; ++step) {
    model::LegAngles leg = before;
    model::legInverseKinematics(model, side_, at(static_cast<double>(step) / kSteps), leg);
    double needed = beside;
    for (std::size_t i = 0; i < leg.size(); ++i) {
      const double most = model.joint(model::jointAt(first + i)).maxSpeed;
      needed = std::max(needed, std::abs(leg[i] - before[i]) / (kOfFullSpeed * most));
    }
    times_[step] = times_[step - 1] + needed;
    before = leg;
  }
  return times_[kSteps];
}

double FootCurve::shareAt(double time) const {
  const auto after = std::upper_bound(times_.begin() + 1, times_.end(), time);
  if (after == times_.end()) return 1.0;
  const auto before = after - 1;
  const double step = static_cast<double>(before - times_.begin());
  return (step + std::max(0.0, time - *before) / (*after - *before)) / kSteps;
}

}  // namespace nonet::motion
