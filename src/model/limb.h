// A leg or an arm as a chain of hinges from the torso: pose and Jacobian of its tip. Used by the solvers that
// work by iteration; the closed forms do not need it.
#pragma once

#include <algorithm>
#include <array>

#include <Eigen/Core>

#include "nonet/model/inverse_kinematics.h"
#include "nonet/model/robot_model.h"

namespace nonet::model {

// Rounding may put an exact solution this far outside a limit.
constexpr double kAngleTolerance = 1e-9;    // rad
constexpr double kLengthTolerance = 1e-10;  // m
// Of the fit that comes nearest where there is no exact solution.
constexpr int kMaxFitIterations = 60;

template <int N>
class Limb {
 public:
  using Angles = Eigen::Matrix<double, N, 1>;
  using Jacobian = Eigen::Matrix<double, 6, N>;  // rows: velocity, then angular velocity of the tip, frame R

  /// The N joints from `first` on; `tip` in the frame of the last body.
  Limb(const RobotModel& model, JointId first, const Vector3& tip) : tip_(tip) {
    for (int i = 0; i < N; ++i) {
      const JointSpec& joint = model.joint(jointAt(index(first) + static_cast<std::size_t>(i)));
      const BodySpec& body = model.body(joint.child);
      links_[i] = {body.offset + joint.anchor, joint.anchor, joint.axis.normalized()};
      low_[i] = joint.low;
      high_[i] = joint.high;
    }
  }

  const Angles& low() const { return low_; }
  const Angles& high() const { return high_; }

  /// X_RT of the tip, and its Jacobian.
  Pose3 evaluate(const Angles& angles, Jacobian* jacobian) const {
    std::array<Vector3, N> anchors;
    std::array<Vector3, N> axes;
    Matrix3 R = Matrix3::Identity();
    Vector3 p = Vector3::Zero();
    for (int i = 0; i < N; ++i) {
      const Link& link = links_[i];
      anchors[i] = p + R * link.p_PA;
      axes[i] = R * link.axis;
      R = R * Eigen::AngleAxisd(angles[i], link.axis).toRotationMatrix();
      p = anchors[i] - R * link.p_BA;
    }
    p += R * tip_;
    if (jacobian != nullptr) {
      for (int i = 0; i < N; ++i) {
        jacobian->template block<3, 1>(0, i) = axes[i].cross(p - anchors[i]);
        jacobian->template block<3, 1>(3, i) = axes[i];
      }
    }
    Pose3 X_RT = Pose3::Identity();
    X_RT.linear() = R;
    X_RT.translation() = p;
    return X_RT;
  }

 private:
  struct Link {
    Vector3 p_PA;  // anchor in the parent's frame
    Vector3 p_BA;  // anchor in the body's frame
    Vector3 axis;
  };
  std::array<Link, N> links_;
  Vector3 tip_;
  Angles low_;
  Angles high_;
};

inline Limb<6> legLimb(const RobotModel& model, Side side) {
  const BodySpec& foot = model.body(side == Side::Left ? BodyId::LFoot : BodyId::RFoot);
  return {model, side == Side::Left ? JointId::LLeg1 : JointId::RLeg1,
          Vector3(-foot.offset.x(), 0.0, -0.5 * foot.shape.size.z())};
}

inline Limb<4> armLimb(const RobotModel& model, Side side) {
  return {model, side == Side::Left ? JointId::LArm1 : JointId::RArm1, Vector3::Zero()};
}

/// Difference of two poses as six lengths, with its derivative. First the position in frame R; then
/// kOrientationLever * 2 sin(angle/2) * axis of the turn from `target` to `pose`, in target axes. With the
/// half angle the derivative is short (for the quaternion q = (w, v): d(2v) = w omega + v x omega), and it is
/// smooth up to half a turn.
struct PoseResidual {
  template <int N>
  static void evaluate(const Limb<N>& limb, const typename Limb<N>::Angles& angles, const Pose3& target,
                       Eigen::Matrix<double, 6, 1>& residual, Eigen::Matrix<double, 6, N>* derivative) {
    typename Limb<N>::Jacobian jacobian;
    const Pose3 pose = limb.evaluate(angles, derivative != nullptr ? &jacobian : nullptr);
    const Matrix3 turn = target.linear().transpose() * pose.linear();
    Eigen::Quaterniond q(turn);
    if (q.w() < 0.0) q.coeffs() *= -1.0;
    residual.template head<3>() = pose.translation() - target.translation();
    residual.template tail<3>() = kOrientationLever * 2.0 * q.vec();
    if (derivative == nullptr) return;
    derivative->template topRows<3>() = jacobian.template topRows<3>();
    const Eigen::Matrix<double, 3, N> omega =
        pose.linear().transpose() * jacobian.template bottomRows<3>();  // body axes of the tip
    for (int i = 0; i < N; ++i) {
      const Vector3 column = omega.col(i);
      derivative->template block<3, 1>(3, i) = kOrientationLever * (q.w() * column + q.vec().cross(column));
    }
  }
};

}  // namespace nonet::model
