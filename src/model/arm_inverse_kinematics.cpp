#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "nonet/math/angle.h"
#include "nonet/model/inverse_kinematics.h"

#include "bounded_fit.h"
#include "limb.h"

namespace nonet::model {

// Notation. Seen from the shoulder, in axes of the upper arm, the elbow lies at (reach, 0, height), and the
// hand (centre of the lower arm), which is f away from the elbow, at
//   u = (reach + f C, f T, height + f S),  C = cos q4, T = sin q4 cos q3, S = sin q4 sin q3.
// The upper arm is turned by R_R,upperarm = Ry(-q1) Rz(q2).
//
// The distance of the target from the shoulder fixes reach C + height S = k. That leaves a curve of solutions
// on the unit sphere (C, T, S). On this curve |q4| is least in one of three places: where T = 0, at an end of
// the part that the limits leave, or where the upper arm points straight to the side and the curve turns
// round.

namespace {

struct ArmGeometry {
  ArmGeometry(const RobotModel& model, Side side) {
    const std::size_t first = index(side == Side::Left ? JointId::LArm1 : JointId::RArm1);
    std::array<const JointSpec*, 4> joints{};
    for (std::size_t i = 0; i < 4; ++i) {
      joints[i] = &model.joint(jointAt(first + i));
      low[i] = joints[i]->low;
      high[i] = joints[i]->high;
    }
    p_RShoulder = model.body(joints[0]->child).p_RB + joints[0]->anchor;
    const Vector3 elbow = model.body(joints[2]->child).offset + joints[2]->anchor - joints[1]->anchor;
    reach = elbow.x();
    height = elbow.z();
    forearm = (model.body(joints[3]->child).offset).x();
  }

  Vector3 p_RShoulder;
  double reach;
  double height;
  double forearm;
  ArmAngles low;
  ArmAngles high;
};

/// Collects solutions and keeps the best one: within the limits, then the least bent elbow.
class ArmSearch {
 public:
  ArmSearch(const ArmGeometry& arm, const Vector3& p) : arm_(arm), p_(p) {
    const double square = p.squaredNorm();
    k_ = (square - arm.reach * arm.reach - arm.height * arm.height - arm.forearm * arm.forearm) /
         (2.0 * arm.forearm);
  }

  void run() {
    // T = 0, q3 = +-90 degrees: the least and the most bent elbow of the whole curve. The least is best if
    // the limits allow it.
    const double least = tryElbowRoll(0.5 * kPi);
    if (found() && std::abs(best_[3]) < least + kAngleTolerance) return;
    const double aside = std::hypot(p_.x(), p_.z());
    for (const double height : {aside, -aside}) tryHeight(height);
    for (const double limit : {arm_.low[0], arm_.high[0]}) tryShoulderPitch(limit);
    for (const double limit : {arm_.low[1], arm_.high[1]}) tryShoulderYaw(limit);
    for (const double limit : {arm_.low[2], arm_.high[2]}) tryElbowRoll(limit);
    for (const double limit : {arm_.low[3], arm_.high[3]}) tryElbow(limit);
  }

  bool found() const { return violation_ <= kAngleTolerance; }
  /// The best solution, not yet clamped: at most kAngleTolerance outside if found().
  const ArmAngles& angles() const { return best_; }

 private:
  /// Tries both elbow angles q4 that belong to this q3: reach cos q4 + height sin q3 sin q4 = k. (A negative
  /// q4 is the arm with q3 + pi and a positive one.) Returns the lesser |q4|.
  double tryElbowRoll(double roll) {
    const double sine = arm_.height * std::sin(roll);
    const double radius = std::hypot(arm_.reach, sine);
    const double middle = std::atan2(sine, arm_.reach);
    if (std::abs(k_) > radius * (1.0 + 1e-12)) return std::numeric_limits<double>::infinity();
    const double half = std::acos(std::clamp(k_ / radius, -1.0, 1.0));
    for (const double elbow : {middle + half, middle - half}) {
      consider(std::cos(elbow), std::sin(elbow) * std::cos(roll), std::sin(elbow) * std::sin(roll));
    }
    return std::min(std::abs(middle + half), std::abs(middle - half));
  }

  /// With q1 known, the height z of the hand over the upper arm is known.
  void tryShoulderPitch(double pitch) { tryHeight(-std::sin(pitch) * p_.x() + std::cos(pitch) * p_.z()); }

  void tryHeight(double z) {
    const double s = (z - arm_.height) / arm_.forearm;
    const double c = (k_ - arm_.height * s) / arm_.reach;
    considerBothSides(c, s);
  }

  /// With q2 known, T is linear in C, and S always is: |(C, T, S)| = 1 is a quadratic equation.
  void tryShoulderYaw(double yaw) {
    const double t0 =
        (p_.y() - std::sin(yaw) * arm_.reach) / (arm_.forearm * std::cos(yaw));  // T = t0 + t1 C
    const double t1 = -std::tan(yaw);
    const double s0 = k_ / arm_.height;  // S = s0 + s1 C
    const double s1 = -arm_.reach / arm_.height;
    const double a = 1.0 + t1 * t1 + s1 * s1;
    const double b = t0 * t1 + s0 * s1;
    const double root = b * b - a * (t0 * t0 + s0 * s0 - 1.0);
    if (root < 0.0) return;
    for (const double signedRoot : {std::sqrt(root), -std::sqrt(root)}) {
      const double c = (-b + signedRoot) / a;
      consider(c, t0 + t1 * c, s0 + s1 * c);
    }
  }

  void tryElbow(double elbow) {
    considerBothSides(std::cos(elbow), (k_ - arm_.reach * std::cos(elbow)) / arm_.height);
  }

  void considerBothSides(double c, double s) {
    const double square = 1.0 - c * c - s * s;
    if (square < 0.0) return;
    consider(c, std::sqrt(square), s);
    consider(c, -std::sqrt(square), s);
  }

  /// All joint angles that belong to a point of the curve.
  void consider(double c, double t, double s) {
    const double bend = std::atan2(std::hypot(s, t), c);
    const double x = arm_.reach + arm_.forearm * c;
    const double y = arm_.forearm * t;
    const double z = arm_.height + arm_.forearm * s;
    const double flat = std::hypot(x, y);
    const double sine = p_.y() / flat;
    if (std::abs(sine) > 1.0 + 1e-12) return;  // the shoulder cannot bring it so far to the side
    const double turn = std::asin(std::clamp(sine, -1.0, 1.0));
    for (const double side : {1.0, -1.0}) {
      const double q3 = bend > 1e-12 ? std::atan2(side * s, side * t) : 0.0;
      for (const double yaw : {turn, kPi - turn}) {
        const double q2 = wrapAngle(yaw - std::atan2(y, x));
        const double q1 = wrapAngle(std::atan2(flat * std::cos(yaw), z) - std::atan2(p_.x(), p_.z()));
        offer({q1, q2, q3, side * bend});
      }
    }
  }

  void offer(const ArmAngles& candidate) {
    double violation = 0.0;
    for (std::size_t i = 0; i < candidate.size(); ++i) {
      violation = std::max({violation, arm_.low[i] - candidate[i], candidate[i] - arm_.high[i]});
    }
    violation = std::max(violation, kAngleTolerance);  // all that is inside counts the same
    // Ties (within rounding) go to the smaller shoulder movement, so that neighbouring targets get
    // neighbouring angles.
    const double cost = std::abs(candidate[3]) +
                        1e-9 * (std::abs(candidate[0]) + std::abs(candidate[1]) + std::abs(candidate[2]));
    if (violation < violation_ || (violation == violation_ && cost < cost_)) {
      violation_ = violation;
      cost_ = cost;
      best_ = candidate;
    }
  }

  const ArmGeometry& arm_;
  Vector3 p_;
  double k_ = 0.0;
  ArmAngles best_{};
  double violation_ = std::numeric_limits<double>::infinity();
  double cost_ = std::numeric_limits<double>::infinity();
};

/// The nearest point within the limits. There are local minima, so it starts from the closed form's clamped
/// solution and from six bent arms.
void fitArm(const RobotModel& model, Side side, const Vector3& p_RH, ArmAngles& angles) {
  const Limb<4> limb = armLimb(model, side);
  const auto residual = [&](const auto& at, auto& difference, auto* derivative) {
    Limb<4>::Jacobian jacobian;
    difference = limb.evaluate(at, &jacobian).translation() - p_RH;
    if (derivative != nullptr) *derivative = jacobian.topRows<3>();
  };
  using Unknowns = Eigen::Matrix<double, 4, 1>;
  const Unknowns middle = 0.5 * (limb.low() + limb.high());
  Unknowns best = Unknowns::Zero();
  double bestCost = std::numeric_limits<double>::infinity();
  constexpr std::array<double, 3> kQuarterTurns{-1.0, 0.0, 1.0};
  for (std::size_t start = 0; start < 7; ++start) {
    Unknowns x = middle;
    if (start == 0) {
      x = Eigen::Map<const Unknowns>(angles.data());
    } else {
      x[0] = 0.5 * kPi * kQuarterTurns[(start - 1) / 2];
      x[2] = start % 2 == 0 ? 1.0 : -1.0;
    }
    const double cost = boundedFit<4, 3>(residual, limb.low(), limb.high(), x, kMaxFitIterations);
    if (cost < bestCost - 1e-18) {
      bestCost = cost;
      best = x;
    }
  }
  Eigen::Map<Unknowns>(angles.data()) = best;
}

}  // namespace

Reach armInverseKinematics(const RobotModel& model, Side side, const Vector3& p_RH, ArmAngles& angles) {
  const ArmGeometry arm(model, side);
  Vector3 p = p_RH - arm.p_RShoulder;
  Reach reach = Reach::Exact;
  // reach C + height S is greatest with the forearm parallel to the line from shoulder to elbow, and least
  // with the elbow at 90 degrees, turned towards that line.
  const double own = arm.reach * arm.reach + arm.height * arm.height + arm.forearm * arm.forearm;
  const double longest = std::hypot(arm.reach, arm.height) + arm.forearm;
  const double shortest = std::sqrt(own - 2.0 * arm.forearm * arm.height);
  const double distance = p.norm();
  if (distance > longest) {
    if (distance > longest + kLengthTolerance) reach = Reach::TooFar;
    p *= longest / distance;
  } else if (distance < shortest) {
    if (distance < shortest - kLengthTolerance) reach = Reach::Limited;
    p = distance > kLengthTolerance ? Vector3(p * (shortest / distance)) : Vector3(0.0, 0.0, -shortest);
  }
  ArmSearch search(arm, p);
  search.run();
  angles = search.angles();
  for (std::size_t i = 0; i < angles.size(); ++i) angles[i] = std::clamp(angles[i], arm.low[i], arm.high[i]);
  if (search.found()) return reach;
  fitArm(model, side, p_RH, angles);
  return reach == Reach::TooFar ? Reach::TooFar : Reach::Limited;
}

void setArmAngles(Side side, const ArmAngles& arm, JointArray& joints) {
  const std::size_t first = index(side == Side::Left ? JointId::LArm1 : JointId::RArm1);
  std::copy(arm.begin(), arm.end(), joints.begin() + static_cast<std::ptrdiff_t>(first));
}

}  // namespace nonet::model
