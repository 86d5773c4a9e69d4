#include "nonet/motion/walk/posture.h"

namespace nonet::motion {

Attitude wantedLean(const WalkPostureParameters& p, const GaitState& gait) {
  const Vector2& step = gait.step.translation;
  const Vector2 tilt = gait.acceleration / kGravity;
  const double slope = step.x() >= 0.0 ? p.pitchPerStep : p.pitchPerStepBack;
  return {.pitch = p.torsoPitch + slope * step.x() + p.accelerationPitch * tilt.x(),
          .roll = -p.rollPerSideStep * step.y() - p.accelerationRoll * tilt.y()};
}

double torsoYawStroke(const WalkPostureParameters& p, const GaitState& gait) {
  return p.yawPerStep * gait.step.translation.x();
}

// A hip yaw-pitch joint that turns its leg outwards swings it forward: while the torso turns to and fro, the
// foot ahead always points outwards, so these joints share the stroke with the hip pitch joints, whose speed
// bounds that of the walk.
double torsoYaw(const WalkPostureParameters& p, const GaitState& gait) {
  if (gait.standing) return 0.0;
  return sideSign(gait.stance) * (2.0 * gait.phase - 1.0) * p.yawPerStep * gait.step.translation.x();
}

ArmAttitude walkingArm(const WalkPostureParameters& p, double otherFoot) {
  return {.pitch = p.armPitch + p.armSwing * otherFoot, .yaw = p.armYaw, .elbow = p.elbow};
}

}  // namespace nonet::motion
