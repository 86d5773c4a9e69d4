#include "nonet/motion/walk/engine.h"

#include <algorithm>
#include <cmath>

#include "nonet/math/rotation.h"

namespace nonet::motion {

using model::Side;

namespace {

Vector3 comOverSole(const model::RobotModel& model, const model::BodyPoses& bodies, Side stance,
                    const Attitude& torso) {
  const Vector3 p_SCom_R =
      model::centerOfMass(model, bodies) - model::solePose(model, bodies, stance).translation();
  return rotationOf(torso) * p_SCom_R;
}

}  // namespace

WalkEngine::WalkEngine(const model::RobotModel& model, const RunParameters& run)
    : model_(&model), run_(run) {}

void WalkEngine::reset() {
  gait_.reset();
  measurement_ = WalkMeasurement{};
  history_.reset();
  trace_ = WalkTrace{};
}

model::JointArray WalkEngine::standAngles(const model::RobotModel& model, const WalkParameters& parameters) {
  WalkEngine engine(model);
  JointTargets targets;
  engine.update(world::BodyState{}, parameters, WalkCommand{}, targets);
  return targets.angles;
}

void WalkEngine::update(const world::BodyState& body, const WalkParameters& p, const WalkCommand& command,
                        JointTargets& targets) {
  const Tilt lastTilt = measurement_.tilt;
  measurement_.tilt = tiltAgainst(p.balance, {.pitch = body.pitch, .roll = body.roll}, body.gyro,
                                  wantedLean(p.posture, gait_.state()));
  moveGait(p, body, command, lastTilt);
  footPoses(p, trace_.feet);
  trace_.reach = setLegs(*model_, trace_.feet, targets.angles);
  moveArms(p.posture, targets.angles);
  straightenToes(targets.angles);
  addRun(run_, gait_.state(), command.run * runShare(p.gait, gait_.state()), *model_, targets.angles);
  targets.stiffness.fill(1.0);
  measureCom(body, p, targets.angles);
}

// Only the run moves them, by adding to this.
void WalkEngine::straightenToes(model::JointArray& angles) const {
  if (!model_->has(model::JointId::LLeg7)) return;
  angles[index(model::JointId::LLeg7)] = angles[index(model::JointId::RLeg7)] = 0.0;
}

Pose2 WalkEngine::speed() const {
  const GaitState& gait = gait_.state();
  return {gait.step.translation / gait.stepDuration, gait.step.rotation / gait.stepDuration};
}

void WalkEngine::moveGait(const WalkParameters& p, const world::BodyState& body, const WalkCommand& command,
                          const Tilt& lastTilt) {
  const Tilt& tilt = measurement_.tilt;
  const Vector2 moves = Eigen::Rotation2Dd(-body.yaw) * body.v_GR.head<2>();
  gait_.update(p.gait, {.cycleTime = body.cycleTime,
                        .command = command,
                        .stepShare = stepShare(p.balance, measurement_.comError),
                        .stumbles = stumbles(p.recovery, lastTilt),
                        .leans = leansTooFar(tilt),
                        .calm = isCalm(p.balance, measurement_),
                        .leanToLeft = -tilt.roll,
                        .push = pushOf(p.recovery, tilt, moves)});
  if (standing()) return;
  Pose2 landing = gait_.landing(p.gait, torsoYawStroke(p.posture, gait_.state()));
  landing.translation += landingShift(p.balance, tilt);
  landing.translation += landingShift(p.recovery, tilt);
  gait_.moveSwingFoot(p.gait, landing);
}

void WalkEngine::footPoses(const WalkParameters& p, FootPoses& feet) const {
  const GaitState& gait = gait_.state();
  const Tilt& tilt = measurement_.tilt;
  const Attitude lean = levelled(p.recovery, steadied(p.balance, wantedLean(p.posture, gait), tilt), tilt);
  const Matrix3 R_RT = rotationOf(lean).transpose();  // T: upright axes at the torso
  const Vector2 p_WT = pendulumOffset(p.pendulum, gait, p.gait.footSeparation);
  const Pose2 X_TW = Pose2(p_WT, torsoYaw(p.posture, gait)).inverse();
  const Attitude ankle = ankleTurn(p.balance, tilt);
  const Attitude level = swingLevel(p.balance, tilt);
  const double lift = gait_.lift(p.gait);
  for (const Side side : {Side::Left, Side::Right}) {
    const Pose2 foot = X_TW * gait_.foot(side);
    Vector3 p_TS = soleBelowTorso(p.pendulum, gait, foot.translation, p_TCom_, model_->standingHeight());
    Attitude sole{.pitch = p.gait.footPitch, .roll = sideSign(side) * p.gait.footRoll};
    if (gait_.swings(side)) {
      p_TS.z() += p.gait.stepHeight * lift;
      sole.pitch += p.gait.swingPitch * lift - level.pitch;
      sole.roll -= level.roll;
    } else if (!standing()) {
      p_TS.z() -= p.gait.stanceStretch * std::sin(kPi * std::clamp(gait.phase, 0.0, 1.0));
      sole.pitch += ankle.pitch;
      sole.roll += ankle.roll;
    }
    const Matrix3 R_TS = turnAboutZ(foot.rotation) * rotationOf(sole);
    feet[index(side)].linear() = R_RT * R_TS;
    feet[index(side)].translation() = R_RT * p_TS;
  }
}

void WalkEngine::moveArms(const WalkPostureParameters& p, model::JointArray& angles) const {
  for (const Side side : {Side::Left, Side::Right}) {
    setArm(side, walkingArm(p, gait_.foot(model::other(side)).translation.x()), angles);
  }
}

// The centre of mass over the stance foot as commanded some cycles ago against that of the measured body.
void WalkEngine::measureCom(const world::BodyState& body, const WalkParameters& p,
                            const model::JointArray& commanded) {
  const GaitState& gait = gait_.state();
  model::forwardKinematics(*model_, commanded, commandedBodies_);
  const Attitude lean = wantedLean(p.posture, gait);
  p_TCom_ = rotationOf(lean) * model::centerOfMass(*model_, commandedBodies_);
  history_.add({.p_SCom = comOverSole(*model_, commandedBodies_, gait.stance, lean),
                .stance = gait.stance,
                .torsoYaw = torsoYaw(p.posture, gait)});
  const CommandHistory::Command* then = history_.measuredNow();
  if (then == nullptr) return;
  measurement_.torsoYaw = then->torsoYaw;
  trace_.p_SComDesired = then->p_SCom;
  const Attitude torso{.pitch = body.pitch, .roll = body.roll};
  trace_.p_SComMeasured = comOverSole(*model_, body.bodies, then->stance, torso);
  measurement_.comError = (trace_.p_SComDesired - trace_.p_SComMeasured).head<2>().cwiseAbs().maxCoeff();
}

}  // namespace nonet::motion
