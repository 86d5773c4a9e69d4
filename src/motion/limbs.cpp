#include "nonet/motion/limbs.h"

#include <algorithm>

namespace nonet::motion {

using model::JointId;
using model::Side;

model::Reach setLegs(const model::RobotModel& model, const FootPoses& feet, model::JointArray& joints) {
  model::Reach worst = model::Reach::Exact;
  for (const Side side : {Side::Left, Side::Right}) {
    model::LegAngles leg{};
    const model::Reach reach = model::legInverseKinematics(model, side, feet[index(side)], leg);
    model::setLegAngles(side, leg, joints);
    worst = std::max(worst, reach);
  }
  return worst;
}

void setArm(Side side, const ArmAttitude& arm, model::JointArray& joints) {
  const double sign = sideSign(side);
  const bool left = side == Side::Left;
  joints[model::index(left ? JointId::LArm1 : JointId::RArm1)] = arm.pitch;
  joints[model::index(left ? JointId::LArm2 : JointId::RArm2)] = sign * arm.yaw;
  joints[model::index(left ? JointId::LArm3 : JointId::RArm3)] = sign * arm.roll;
  joints[model::index(left ? JointId::LArm4 : JointId::RArm4)] = -sign * arm.elbow;
}

}  // namespace nonet::motion
