#include "nonet/model/kinematics.h"

namespace nonet::model {

void forwardKinematics(const RobotModel& model, const JointArray& angles, BodyPoses& poses) {
  poses.fill(Pose3::Identity());
  for (const BodySpec& body : model.bodies()) {
    if (!body.joint) continue;  // the torso: frame R itself
    const JointSpec& joint = model.joint(*body.joint);
    // All bodies are axis-parallel at zero pose (server facts 2.2), so the axis has the same coordinates in
    // torso, parent and child frame. The child turns about its anchor A:
    // X_PB = translate(p_PA) rotate(q) translate(-p_BA), with p_PA = offset + anchor.
    const Matrix3 R_PB =
        Eigen::AngleAxisd(angles[index(joint.id)], joint.axis.normalized()).toRotationMatrix();
    const Pose3& X_RP = poses[index(body.parent)];
    Pose3& X_RB = poses[index(body.id)];
    const Vector3 p_PB = body.offset + joint.anchor - R_PB * joint.anchor;
    X_RB.linear() = X_RP.linear() * R_PB;
    X_RB.translation() = X_RP.translation() + X_RP.linear() * p_PB;
  }
}

Vector3 centerOfMass(const RobotModel& model, const BodyPoses& poses) {
  Vector3 moment = Vector3::Zero();
  for (const BodySpec& body : model.bodies()) moment += body.mass * poses[index(body.id)].translation();
  return moment / model.totalMass();
}

Pose3 solePose(const RobotModel& model, const BodyPoses& poses, Side side) {
  const BodyId id = side == Side::Left ? BodyId::LFoot : BodyId::RFoot;
  const BodySpec& foot = model.body(id);
  // The ankle's centre lies above the sole point; the foot's offset from it says how far ahead the foot's
  // centre is.
  const Vector3 p_FS(-foot.offset.x(), 0.0, -0.5 * foot.shape.size.z());
  Pose3 X_RS = poses[index(id)];
  X_RS.translation() += X_RS.linear() * p_FS;
  return X_RS;
}

}  // namespace nonet::model
