#include "nonet/motion/walk/run.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace nonet::motion {

namespace {

using model::JointId;
using model::Side;

struct Swung {
  const JointSwing* swing;
  JointId left, right;
  double leftSign, rightSign;
};

// Hips and ankles roll outwards to opposite sides, and elbows bend so; all else is alike on both sides.
std::array<Swung, 8> swungJoints(const RunParameters& p) {
  return {{{&p.hipYawPitch, JointId::LLeg1, JointId::RLeg1, 1.0, 1.0},
           {&p.hipRoll, JointId::LLeg2, JointId::RLeg2, 1.0, -1.0},
           {&p.hipPitch, JointId::LLeg3, JointId::RLeg3, 1.0, 1.0},
           {&p.knee, JointId::LLeg4, JointId::RLeg4, 1.0, 1.0},
           {&p.anklePitch, JointId::LLeg5, JointId::RLeg5, 1.0, 1.0},
           {&p.ankleRoll, JointId::LLeg6, JointId::RLeg6, 1.0, -1.0},
           {&p.shoulder, JointId::LArm1, JointId::RArm1, 1.0, 1.0},
           {&p.elbow, JointId::LArm4, JointId::RArm4, -1.0, 1.0}}};
}

double strideOf(const GaitState& gait, Side side) {
  return 0.5 * gait.phase + (gait.stance == side ? 0.0 : 0.5);
}

}  // namespace

double JointSwing::at(double stride) const {
  const double angle = 2.0 * kPi * stride;
  return mean + cos1 * std::cos(angle) + sin1 * std::sin(angle) + cos2 * std::cos(2.0 * angle) +
         sin2 * std::sin(2.0 * angle);
}

double runShare(const GaitParameters& p, const GaitState& gait) {
  if (gait.standing || p.maxStepX <= 0.0) return 0.0;
  return std::clamp(gait.step.translation.x() / p.maxStepX, 0.0, 1.0);
}

void addRun(const RunParameters& p, const GaitState& gait, double share, const model::RobotModel& model,
            model::JointArray& angles) {
  if (share <= 0.0) return;
  const double left = strideOf(gait, Side::Left);
  const double right = strideOf(gait, Side::Right);
  for (const Swung& joint : swungJoints(p)) {
    angles[model::index(joint.left)] += share * joint.leftSign * joint.swing->at(left);
    angles[model::index(joint.right)] += share * joint.rightSign * joint.swing->at(right);
  }
  if (!model.has(JointId::LLeg7)) return;
  angles[model::index(JointId::LLeg7)] += share * p.toe.at(left);
  angles[model::index(JointId::RLeg7)] += share * p.toe.at(right);
}

}  // namespace nonet::motion
