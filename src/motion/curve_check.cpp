#include "nonet/motion/curve_check.h"

#include <cmath>

#include "nonet/model/kinematics.h"
#include "nonet/motion/foot_curve.h"
#include "nonet/motion/limbs.h"
#include "nonet/world/ball_law.h"

namespace nonet::motion {

using model::Side;

namespace {

constexpr Side kStance = Side::Right;  // of the kick with the left foot

// The ball seen from the stance foot, which the weight's shift does not move. The sole is flat on the ground,
// so it tells which way is up.
Vector3 fromStanceFoot(const Pose3& X_RS, const Vector2& p_RBall) {
  const Vector3 ahead = X_RS.linear().col(0);
  const Matrix3 R_LR =
      Eigen::AngleAxisd(std::atan2(ahead.y(), ahead.x()), Vector3::UnitZ()).toRotationMatrix() *
      X_RS.linear().transpose();
  const Vector3 p_LS = R_LR * X_RS.translation();
  const Vector3 p_LB(p_RBall.x(), p_RBall.y(), p_LS.z() + world::kBallRestHeight);
  return (R_LR * X_RS.linear()).transpose() * (p_LB - p_LS);
}

// What a statement before the curve makes of the joints, as far as its text tells.
void apply(const model::RobotModel& model, const Instruction& instruction, const model::JointArray& stand,
           model::JointArray& posture) {
  if (instruction.stand) posture = stand;
  for (const JointGoal& goal : instruction.joints) {
    if (instruction.kind != Instruction::Kind::Stiffness && model.has(goal.joint))
      posture[model::index(goal.joint)] = goal.angle.constant;
  }
  for (const FootGoal& goal : instruction.feet) {
    Pose3 X_RS = Pose3::Identity();
    X_RS.translation() = goal.position;
    X_RS.linear() = rotationOf(goal.rollPitchYaw);
    model::LegAngles leg{};
    model::legInverseKinematics(model, goal.side, X_RS, leg);
    model::setLegAngles(goal.side, leg, posture);
  }
}

bool overStanceFoot(const model::RobotModel& model, const model::BodyPoses& bodies) {
  const model::BodyId foot = kStance == Side::Right ? model::BodyId::RFoot : model::BodyId::LFoot;
  const Vector3 p_FCom = bodies[model::index(foot)].inverse() * model::centerOfMass(model, bodies);
  const Vector3& size = model.body(foot).shape.size;
  return std::abs(p_FCom.x()) < 0.5 * size.x() - CurveCheck::kInsideFoot &&
         std::abs(p_FCom.y()) < 0.5 * size.y() - CurveCheck::kInsideFoot;
}

}  // namespace

CurveCheck::CurveCheck(const model::RobotModel& model, const SkillLibrary& library,
                       const model::JointArray& stand)
    : model_(&model), stand_(stand), kicks_(library.size()) {
  for (std::size_t i = 0; i < library.size(); ++i) {
    const Skill& skill = library.skill(static_cast<int>(i));
    if (!skill.kick) continue;
    kicks_[i].posture = stand;
    for (const Instruction& instruction : skill.program) {
      const bool curve = instruction.kind == Instruction::Kind::Curve && instruction.fromBall;
      if (curve && instruction.points[0].side != kStance) {
        kicks_[i].curve = &instruction;
        break;
      }
      apply(model, instruction, stand, kicks_[i].posture);
    }
  }
}

CurveCheck::Result CurveCheck::check(const KickOption& option, const Vector2& p_RBall) const {
  const Kick& kick = kicks_[static_cast<std::size_t>(option.skill)];
  Result result;
  if (kick.curve == nullptr) return result;
  const Vector2 ball(p_RBall.x(), option.foot == Side::Right ? -p_RBall.y() : p_RBall.y());
  model::BodyPoses bodies = model::identityPoses();
  model::forwardKinematics(*model_, stand_, bodies);
  const Vector3 p_SBall = fromStanceFoot(model::solePose(*model_, bodies, kStance), ball);
  model::JointArray joints = kick.posture;
  model::forwardKinematics(*model_, joints, bodies);
  FootCurve curve;
  curve.plan(*kick.curve, false, model::solePose(*model_, bodies, model::other(kStance)),
             model::solePose(*model_, bodies, kStance) * p_SBall);
  int missed = 0;
  for (int i = 1; i <= kSamples && result.allows(); ++i) {
    model::LegAngles leg{};
    if (!model::legReaches(*model_, curve.side(), curve.at(static_cast<double>(i) / kSamples), leg)) {
      result.reached = 1.0 - static_cast<double>(++missed) / kSamples;
      continue;
    }
    model::setLegAngles(curve.side(), leg, joints);
    model::forwardKinematics(*model_, joints, bodies);
    result.balanced = overStanceFoot(*model_, bodies);
  }
  return result;
}

}  // namespace nonet::motion
