#include "nonet/motion/curve_check.h"

#include <algorithm>
#include <cmath>

#include "nonet/math/rotation.h"
#include "nonet/model/kinematics.h"
#include "nonet/motion/foot_curve.h"
#include "nonet/motion/limbs.h"
#include "nonet/world/ball_law.h"

namespace nonet::motion {

using model::Side;

namespace {

constexpr Side kStance = Side::Right;  // of the kick with the left foot

// The sole is flat on the ground, so it tells which way is up; the heading is the torso's.
Matrix3 levelFrame(const Pose3& X_RS) {
  const Vector3 ahead = X_RS.linear().col(0);
  return turnAboutZ(std::atan2(ahead.y(), ahead.x())) * X_RS.linear().transpose();
}

// The ball seen from the stance foot, which the weight's shift does not move.
Vector3 fromStanceFoot(const Pose3& X_RS, const Vector2& p_RBall) {
  const Matrix3 R_LR = levelFrame(X_RS);
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

}  // namespace

double insideStanceFoot(const model::RobotModel& model, const model::BodyPoses& bodies) {
  const model::BodyId foot = kStance == Side::Right ? model::BodyId::RFoot : model::BodyId::LFoot;
  const Vector3 p_FCom = bodies[model::index(foot)].inverse() * model::centerOfMass(model, bodies);
  const Vector3& size = model.body(foot).shape.size;
  return std::min(0.5 * size.x() - std::abs(p_FCom.x()), 0.5 * size.y() - std::abs(p_FCom.y()));
}

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
        // The program ends with a statement of its own, so there is a next one.
        kicks_[i].meetsBall = (&instruction + 1)->kind != Instruction::Kind::Swing;
        break;
      }
      apply(model, instruction, stand, kicks_[i].posture);
    }
  }
}

std::optional<PlannedCurve> CurveCheck::plan(const KickOption& option, const Vector2& p_RBall) const {
  const Kick& kick = kicks_[static_cast<std::size_t>(option.skill)];
  if (kick.curve == nullptr) return std::nullopt;
  model::BodyPoses bodies = model::identityPoses();
  model::forwardKinematics(*model_, stand_, bodies);
  const Pose3 X_RStand = model::solePose(*model_, bodies, kStance);
  const Vector3 p_SBall = fromStanceFoot(X_RStand, p_RBall);
  PlannedCurve planned;
  planned.instruction = kick.curve;
  planned.meetsBall = kick.meetsBall;
  planned.posture = kick.posture;
  model::forwardKinematics(*model_, planned.posture, bodies);
  const Pose3 X_RS = model::solePose(*model_, bodies, kStance);
  planned.curve.plan(*kick.curve, false, model::solePose(*model_, bodies, model::other(kStance)),
                     X_RS * p_SBall);
  planned.R_LR = levelFrame(X_RStand) * X_RStand.linear() * X_RS.linear().transpose();
  return planned;
}

CurveCheck::Result CurveCheck::check(const KickOption& option, const Vector2& p_RBall) const {
  const Vector2 ball(p_RBall.x(), option.foot == Side::Right ? -p_RBall.y() : p_RBall.y());
  Result result;
  std::optional<PlannedCurve> planned = plan(option, ball);
  if (!planned) return result;
  const FootCurve& curve = planned->curve;
  model::JointArray& joints = planned->posture;
  model::BodyPoses bodies = model::identityPoses();
  model::forwardKinematics(*model_, joints, bodies);
  int missed = 0;
  for (int i = 1; i <= kSamples && result.allows(); ++i) {
    model::LegAngles leg{};
    if (!model::legReaches(*model_, curve.side(), curve.at(static_cast<double>(i) / kSamples), leg)) {
      result.reached = 1.0 - static_cast<double>(++missed) / kSamples;
      continue;
    }
    model::setLegAngles(curve.side(), leg, joints);
    model::forwardKinematics(*model_, joints, bodies);
    result.balanced = insideStanceFoot(*model_, bodies) > kInsideFoot;
  }
  return result;
}

}  // namespace nonet::motion
