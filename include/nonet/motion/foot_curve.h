// The way of a foot along a curve: a cubic Hermite spline through points at equal times, at rest at both
// ends, attitudes interpolated linearly between them [MacAlpine 2012a, section 5.1.3]. It keeps its shape
// when what it is relative to moves, and its joints' speed limits by taking longer.
#pragma once

#include <array>

#include "nonet/math/hermite_spline.h"
#include "nonet/model/robot_model.h"
#include "nonet/motion/skill.h"

namespace nonet::motion {

/// Rotation of a sole, and back; rad, applied as yaw, then pitch, then roll.
Matrix3 rotationOf(const Vector3& rollPitchYaw);
Vector3 anglesOf(const Matrix3& rotation);
/// As the other foot does it.
FootGoal mirroredGoal(FootGoal goal);

class FootCurve {
 public:
  static constexpr std::size_t kSteps = 24;     // in which the time that it takes is reckoned
  static constexpr double kOfFullSpeed = 0.95;  // in the mean of a step: within it a joint's speed varies

  /// Through the points of `curve` as the left foot has them, or `mirrored`, from where the sole is (X_RFrom,
  /// torso frame). `origin`: what the points are relative to, torso frame, m.
  void plan(const Instruction& curve, bool mirrored, const Pose3& X_RFrom, const Vector3& origin);
  /// What the points are relative to lies elsewhere now: the rest of the way leads there.
  void moveTo(const Vector3& origin);
  const Vector3& origin() const { return origin_; }
  model::Side side() const { return side_; }

  /// The sole at a share 0 .. 1 of the way, torso frame.
  Pose3 at(double share) const;

  /// Reckons how long it takes when no leg joint, and no joint that goes from `from` to `to` beside it (those
  /// with a bit in `moves`), is faster than it can be: wherever one would be, that part takes longer. Returns
  /// the time, s; at least `wanted`.
  double setPace(const model::RobotModel& model, double wanted, const model::JointArray& from,
                 const model::JointArray& to, std::uint32_t moves);
  /// The share of the way that is done so long after its begin; by the last setPace().
  double shareAt(double time) const;

 private:
  HermiteSpline<Vector3, Instruction::kMostPoints + 1> spline_;
  std::array<Vector3, Instruction::kMostPoints> points_{};  // relative to the origin
  std::array<Vector3, Instruction::kMostPoints + 1> attitudes_{};
  std::size_t count_ = 0;  // of points
  Vector3 from_ = Vector3::Zero();
  Vector3 origin_ = Vector3::Zero();
  model::Side side_ = model::Side::Left;
  std::array<double, kSteps + 1> times_{};  // when each step is over, s
};

}  // namespace nonet::motion
