#include "skill_joints.h"

#include <algorithm>
#include <array>
#include <limits>

#include <fmt/format.h>

#include "nonet/math/angle.h"
#include "nonet/model/robot_model.h"
#include "nonet/motion/skill_language.h"

namespace nonet::motion {

namespace {

using config::Unit;
using model::JointId;

struct JointWord {
  std::string_view name;
  JointId left;
};
constexpr std::array<JointWord, 11> kLimbJoints{{{"shoulderPitch", JointId::LArm1},
                                                 {"shoulderYaw", JointId::LArm2},
                                                 {"armRoll", JointId::LArm3},
                                                 {"elbow", JointId::LArm4},
                                                 {"hipYawPitch", JointId::LLeg1},
                                                 {"hipRoll", JointId::LLeg2},
                                                 {"hipPitch", JointId::LLeg3},
                                                 {"knee", JointId::LLeg4},
                                                 {"anklePitch", JointId::LLeg5},
                                                 {"ankleRoll", JointId::LLeg6},
                                                 {"toe", JointId::LLeg7}}};

bool isRight(JointId joint) {
  return (joint >= JointId::RArm1 && joint <= JointId::RArm4) ||
         (joint >= JointId::RLeg1 && joint <= JointId::RLeg7);
}

KickValue negated(const KickValue& value) {
  return {-value.constant, -value.per};
}

// Only when errors are collected: learned values of parameters may lie outside, and the joint then stops at
// its limit.
void checkLimits(const SkillReader& reader, const SkillToken& token, JointId joint, double angle) {
  if (!reader.collects()) return;
  config::Range widest{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (int type = 0; type <= 4; ++type) {
    const model::RobotModel& robot = model::robotModel(type);
    if (!robot.has(joint)) continue;
    widest.low = std::min(widest.low, robot.joint(joint).low);
    widest.high = std::max(widest.high, robot.joint(joint).high);
  }
  constexpr double kRounding = 1e-6;
  if (angle >= widest.low - kRounding && angle <= widest.high + kRounding) return;
  // As it stands in the file: tilt is turned round there.
  const double sign = joint == JointId::Head2 ? -1.0 : 1.0;
  const double a = toDegrees(sign * widest.low);
  const double b = toDegrees(sign * widest.high);
  reader.note(token, fmt::format("{:.4g} deg is out of the joint's reach, {:.4g} .. {:.4g} deg",
                                 toDegrees(sign * angle), std::min(a, b), std::max(a, b)));
}

// Behind "head.". Tilt is positive downwards here as in a head request; the joint is positive upwards.
void readHead(SkillReader& reader, std::vector<JointGoal>& goals, bool withAngle) {
  const SkillToken nameToken = reader.peek();
  const std::string name = reader.word("the name of a joint");
  if (name != "pan" && name != "tilt") reader.failAt(nameToken, "the head has the joints pan and tilt");
  const bool pan = name == "pan";
  const SkillToken angleToken = reader.peek();
  const KickValue angle = withAngle ? reader.kickValue(Unit::Radian) : KickValue{};
  const JointId joint = pan ? JointId::Head1 : JointId::Head2;
  if (withAngle) checkLimits(reader, angleToken, joint, pan ? angle.constant : -angle.constant);
  goals.push_back({joint, pan ? angle : negated(angle), {}});
}

}  // namespace

void readJoints(SkillReader& reader, std::vector<JointGoal>& goals, bool withAngle) {
  const SkillToken first = reader.peek();
  const std::string group = reader.word("a joint (left.knee, both.elbow, head.pan), 'foot' or '}'");
  if (group != "left" && group != "right" && group != "both" && group != "head") {
    reader.failAt(first, fmt::format("'{}' is no side (left right both head)", group));
  }
  reader.expect(".");
  if (group == "head") return readHead(reader, goals, withAngle);
  const SkillToken nameToken = reader.peek();
  const std::string name = reader.word("the name of a joint");
  const auto found = std::find_if(kLimbJoints.begin(), kLimbJoints.end(),
                                  [&](const JointWord& joint) { return joint.name == name; });
  if (found == kLimbJoints.end()) reader.failAt(nameToken, fmt::format("unknown joint '{}'", name));
  const SkillToken angleToken = reader.peek();
  const KickValue angle = withAngle ? reader.kickValue(Unit::Radian) : KickValue{};
  if (withAngle) checkLimits(reader, angleToken, found->left, angle.constant);
  const JointId right = model::mirrored(found->left);
  if (group != "right") goals.push_back({found->left, angle, {}});
  if (group != "left") goals.push_back({right, mirrorsSign(right) ? negated(angle) : angle, {}});
}

bool mirrorsSign(JointId joint) {
  switch (joint) {
    case JointId::Head1:
    case JointId::LArm2:
    case JointId::LArm3:
    case JointId::LArm4:
    case JointId::LLeg2:
    case JointId::LLeg6:
    case JointId::RArm2:
    case JointId::RArm3:
    case JointId::RArm4:
    case JointId::RLeg2:
    case JointId::RLeg6:
      return true;
    default:
      return false;
  }
}

std::string jointWord(JointId joint) {
  if (joint == JointId::Head1) return "head.pan";
  if (joint == JointId::Head2) return "head.tilt";
  const JointId left = isRight(joint) ? model::mirrored(joint) : joint;
  const auto found = std::find_if(kLimbJoints.begin(), kLimbJoints.end(),
                                  [&](const JointWord& word) { return word.left == left; });
  return fmt::format("{}.{}", isRight(joint) ? "right" : "left", found->name);
}

bool countsBackwards(JointId joint) {
  return joint == JointId::Head2 || (isRight(joint) && mirrorsSign(joint));
}

}  // namespace nonet::motion
