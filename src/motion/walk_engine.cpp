#include "nonet/motion/walk_engine.h"

#include <algorithm>
#include <cmath>

namespace nonet::motion {

using model::Side;

namespace {

// Steps smaller than this are none: a stand may follow.
constexpr double kStepTolerance = 5e-3;  // m
constexpr double kTurnTolerance = 0.03;  // rad
constexpr int kStepsBeforeStand = 2;     // in place, so that both feet have come home
constexpr double kUprightTilt = 0.08;    // rad; a stand takes care of what sways less
constexpr int kMostStepsInPlace = 25;    // then stand even with an error

Pose2 scaled(const Pose2& pose, double factor) {
  return {pose.translation * factor, pose.rotation * factor};
}

// 0 before the begin, 1 after the end; between them a half cosine, or, with straightness 1, a straight line,
// whose greatest speed is 2 / pi of that: joints run at their speed limits in fast steps.
double progress(double t, double begin, double length, double straightness) {
  const double u = std::clamp((t - begin) / length, 0.0, 1.0);
  return (1.0 - straightness) * 0.5 * (1.0 - std::cos(kPi * u)) + straightness * u;
}

// Of a gap of which `share` is closed in a cycle.
double shareAfter(double cycles, double share) {
  return 1.0 - std::pow(1.0 - std::min(share, 1.0), cycles);
}

double approach(double value, double goal, double share, double maxChange) {
  return value + std::clamp(share * (goal - value), -maxChange, maxChange);
}

// What a tilt is beyond the limit.
double beyond(double tilt, double limit) {
  return tilt - std::clamp(tilt, -limit, limit);
}

Matrix3 tiltRotation(double pitch, double roll) {
  return (Eigen::AngleAxisd(pitch, Vector3::UnitY()) * Eigen::AngleAxisd(roll, Vector3::UnitX()))
      .toRotationMatrix();
}

Vector3 comOverSole(const model::RobotModel& model, const model::BodyPoses& bodies, Side stance, double pitch,
                    double roll) {
  const Vector3 p_SCom_R =
      model::centerOfMass(model, bodies) - model::solePose(model, bodies, stance).translation();
  return tiltRotation(pitch, roll) * p_SCom_R;
}

}  // namespace

WalkEngine::WalkEngine(const model::RobotModel& model) : model_(&model) {}

void WalkEngine::reset() {
  mode_ = Mode::Standing;
  phase_ = 1.0;
  wanted_ = step_ = odometryStep_ = Pose2{};
  acceleration_ = Vector2::Zero();
  historySize_ = 0;
  trace_ = WalkTrace{};
  feetPlaced_ = false;
}

model::JointArray WalkEngine::standAngles(const model::RobotModel& model, const WalkParameters& parameters) {
  WalkEngine engine(model);
  JointTargets targets;
  engine.update(world::BodyState{}, parameters, Pose2{}, false, targets);
  return targets.angles;
}

void WalkEngine::update(const world::BodyState& body, const WalkParameters& parameters, const Pose2& speed,
                        bool walk, JointTargets& targets) {
  parameters_ = parameters;
  if (!feetPlaced_) placeFeet();
  const Tilt tilt = tiltError(body);
  updateStepSize(body.cycleTime / kCycleTime, speed, walk);
  advancePhase(body.cycleTime, walk, speed, tilt);
  moveFrame(body.cycleTime);
  if (mode_ != Mode::Standing) moveSwingFoot(tilt);

  footPoses(tilt, trace_.feet);
  trace_.reach = setLegs(*model_, trace_.feet, targets.angles);
  moveArms(targets.angles);
  targets.stiffness.fill(1.0);
  measureComError(body, targets.angles);
  trace_.phase = phase_;
  trace_.stance = stance_;
  trace_.step = step_;
  trace_.pitchError = tilt.pitch;
  trace_.rollError = tilt.roll;
}

void WalkEngine::placeFeet() {
  for (const Side side : {Side::Left, Side::Right}) {
    const double sign = sideSign(side);
    feet_[index(side)] = Pose2(0.0, 0.5 * sign * parameters_.ySep, sign * parameters_.footYaw);
  }
  swingStart_ = feet_[index(model::other(stance_))];
  feetPlaced_ = true;
}

// Whole cycles: a gait of three cycles is regular, one of 3.1 would limp every tenth step.
double WalkEngine::stepTime(const WalkParameters& parameters) {
  return kCycleTime * std::max(1.0, std::round(parameters.phiLength / kCycleTime));
}

// The proportional filter of [MacAlpine 2012b, walk engine], with a bound on the change, then the brake.
void WalkEngine::updateStepSize(double cycles, const Pose2& speed, bool walk) {
  const WalkParameters& p = parameters_;
  Pose2 desired = walk ? scaled(speed, stepTime()) : Pose2{};
  const double maxX = desired.translation.x() >= 0.0 ? p.maxStepX : p.maxStepXBack;
  const auto share = [](double value, double most) { return most > 0.0 ? std::abs(value) / most : 1e3; };
  const double e = p.combineExponent;
  const double norm = std::pow(std::pow(share(desired.translation.x(), maxX), e) +
                                   std::pow(share(desired.translation.y(), p.maxStepY), e) +
                                   std::pow(share(desired.rotation, p.maxStepTheta), e),
                               1.0 / e);
  if (norm > 1.0) desired = scaled(desired, 1.0 / norm);

  const auto closed = [cycles](double delta) { return shareAfter(cycles, delta); };
  const auto change = [&](double value, double goal, double delta, double most) {
    const bool shrinks = value * (goal - value) < 0.0;
    const double factor = shrinks ? p.brake : 1.0;
    return approach(value, goal, closed(factor * delta), factor * most * cycles);
  };
  Vector2& w = wanted_.translation;
  w.x() = change(w.x(), desired.translation.x(), p.deltaStepX, p.maxChangeX);
  w.y() = change(w.y(), desired.translation.y(), p.deltaStepY, p.maxChangeY);
  wanted_.rotation =
      approach(wanted_.rotation, desired.rotation, closed(p.deltaStepTheta), p.maxChangeTheta * cycles);
  if (!walk && w.cwiseAbs().maxCoeff() < kStepTolerance && std::abs(wanted_.rotation) < kTurnTolerance) {
    wanted_ = Pose2{};
  }
  // err_norm and err_max of [MacAlpine 2012b]: a large error of the centre of mass shrinks the steps.
  const double range = std::max(p.errMax - p.errNorm, 1e-6);
  const Vector2 before = step_.translation;
  step_ = scaled(wanted_, std::clamp((p.errMax - trace_.comError) / range, 0.0, 1.0));
  // Who stumbles speeds up anew afterwards, instead of leaping back to the full step.
  if (std::max(std::abs(trace_.pitchError), std::abs(trace_.rollError)) > p.recoverTilt) wanted_ = step_;
  updateAcceleration(step_.translation - before, cycles);
}

// In the walk frame: the change of speed, and that of its direction in a curve.
void WalkEngine::updateAcceleration(const Vector2& stepChange, double cycles) {
  if (cycles <= 0.0) return;  // the first message of all
  const WalkParameters& p = parameters_;
  const double turnRate = step_.rotation / stepTime();
  const Vector2 speed = step_.translation / stepTime();
  const Vector2 commanded =
      stepChange / (stepTime() * kCycleTime * cycles) + turnRate * Vector2(-speed.y(), speed.x());
  acceleration_ += shareAfter(cycles, p.accelerationFilter) * (commanded - acceleration_);
}

// The attitude that the torso should have.
WalkEngine::Lean WalkEngine::lean() const {
  const WalkParameters& p = parameters_;
  const Vector2 tilt = acceleration_ / kGravity;
  const double slope = step_.translation.x() >= 0.0 ? p.torsoPitchStep : p.torsoPitchStepBack;
  return {.pitch = p.torsoPitch + slope * step_.translation.x() + p.accelerationPitch * tilt.x(),
          .roll = -p.torsoRollStep * step_.translation.y() - p.accelerationRoll * tilt.y()};
}

// A hip yaw-pitch joint that turns its leg outwards swings it forward: while the torso turns to and fro, the
// foot ahead always points outwards, so these joints share the stroke with the hip pitch joints, whose speed
// bounds that of the walk.
double WalkEngine::torsoYaw() const {
  if (mode_ == Mode::Standing) return 0.0;
  return sideSign(stance_) * (2.0 * phase_ - 1.0) * parameters_.torsoYawStep * step_.translation.x();
}

void WalkEngine::advancePhase(double cycleTime, bool walk, const Pose2& speed, const Tilt& tilt) {
  if (mode_ == Mode::Standing) {
    const bool leans = std::max(std::abs(tilt.pitch), std::abs(tilt.roll)) > parameters_.balanceTilt;
    if (!walk && !leans) return;
    // The first step is made by the foot on the side of the motion, or of the lean.
    const double toLeft = walk ? speed.translation.y() + 0.1 * speed.rotation : -tilt.roll;
    stance_ = toLeft >= 0.0 ? Side::Right : Side::Left;
    swingStart_ = feet_[index(model::other(stance_))];
    phase_ = 0.0;
    stepsDone_ = 0;
  } else if (phase_ >= 1.0 - 1e-6) {
    ++stepsDone_;
    const bool inPlace = !walk && wanted_.translation.isZero() && wanted_.rotation == 0.0;
    stepsInPlace_ = inPlace ? stepsInPlace_ + 1 : 0;
    const bool upright = std::max(std::abs(tilt.pitch), std::abs(tilt.roll)) < kUprightTilt;
    const bool calm = upright || trace_.comError < parameters_.errNorm || stepsInPlace_ > kMostStepsInPlace;
    if (stepsInPlace_ > kStepsBeforeStand && calm) {
      mode_ = Mode::Standing;
      step_ = Pose2{};
      return;
    }
    stance_ = model::other(stance_);
    swingStart_ = feet_[index(model::other(stance_))];
    phase_ = 0.0;
  }
  mode_ = walk ? Mode::Walking : Mode::Stopping;
  phase_ = std::min(1.0, phase_ + cycleTime / stepTime());
}

// The walk frame moves steadily; what stands on the ground moves backwards in it.
void WalkEngine::moveFrame(double cycleTime) {
  odometryStep_ = mode_ == Mode::Standing ? Pose2{} : scaled(step_, cycleTime / stepTime());
  const Pose2 back = odometryStep_.inverse();
  for (Pose2& foot : feet_) foot = back * foot;
  swingStart_ = back * swingStart_;
}

void WalkEngine::moveSwingFoot(const Tilt& tilt) {
  const WalkParameters& p = parameters_;
  const Side swing = model::other(stance_);
  const double sign = sideSign(swing);
  // Half a step ahead of where the walk frame will be at the landing; the other half follows while the foot
  // is stance foot.
  const double wider = p.turnOut * std::abs(step_.rotation) + p.sideOut * std::abs(step_.translation.y());
  const double side = sign * (0.5 * p.ySep + wider);
  const double outwards = sign * (p.footYaw + p.turnYaw * std::abs(step_.rotation) +
                                  p.yawOut * std::abs(p.torsoYawStep * step_.translation.x()));
  Pose2 landing =
      scaled(step_, 1.0 - phase_) *
      Pose2(0.5 * step_.translation.x(), side + 0.5 * step_.translation.y(), 0.5 * step_.rotation + outwards);
  landing.translation.x() += p.stepPitchGain * tilt.pitch + p.stepPitchRateGain * tilt.pitchRate;
  landing.translation.y() -= p.stepRollGain * tilt.roll + p.stepRollRateGain * tilt.rollRate;
  landing.translation.x() += p.recoverStepPitch * beyond(tilt.pitch, p.recoverTilt);
  landing.translation.y() -= p.recoverStepRoll * beyond(tilt.roll, p.recoverTilt);
  const double moved = progress(phase_, p.fS, p.fM, p.swingStraightness);
  Pose2& foot = feet_[index(swing)];
  foot.translation = (1.0 - moved) * swingStart_.translation + moved * landing.translation;
  foot.rotation = swingStart_.rotation + moved * wrapAngle(landing.rotation - swingStart_.rotation);
}

// Torso over the walk frame. Sideways the linear pendulum x'' = k^2 x over the stance foot, symmetric about
// the middle of the step: distance d cosh(k tau) / cosh(k T/2) with d the distance at the change of feet.
// Forward d sinh(k tau) / sinh(k T/2) with d half a step, of which the walk frame already makes the steady
// part.
Vector2 WalkEngine::pendulumOffset() const {
  if (mode_ == Mode::Standing) return Vector2::Zero();
  const WalkParameters& p = parameters_;
  const double halfTime = 0.5 * stepTime();
  const double k = std::sqrt(kGravity / p.pendulumHeight);
  const double tau = (2.0 * phase_ - 1.0) * halfTime;
  const double halfSep = 0.5 * p.ySep;
  const double natural = halfSep * (1.0 - std::cosh(k * tau) / std::cosh(k * halfTime));
  const double full = halfSep * (1.0 - 1.0 / std::cosh(k * halfTime));
  const double y = p.swayFactor * natural + p.yShift * natural / full;
  const double x = 0.5 * step_.translation.x() * p.xPendulum *
                   (std::sinh(k * tau) / std::sinh(k * halfTime) - tau / halfTime);
  return {x, sideSign(stance_) * y};
}

double WalkEngine::lift() const {
  const WalkParameters& p = parameters_;
  const double u = (phase_ - p.fG) / p.fA;
  if (mode_ == Mode::Standing || u < 0.0 || u > 1.0) return 0.0;
  const double share = stepsDone_ == 0 ? p.startLift : 1.0;
  return share * progress(1.0 - std::abs(2.0 * u - 1.0), 0.0, 1.0, p.liftStraightness);
}

void WalkEngine::footPoses(const Tilt& tilt, FootPoses& feet) const {
  const WalkParameters& p = parameters_;
  const Pose2 X_TW = Pose2(pendulumOffset(), torsoYaw()).inverse();
  const double liftShare = lift();
  const double middle = std::sin(kPi * std::clamp(phase_, 0.0, 1.0));
  const double height = p.zTorso * model_->standingHeight();
  const Lean desired = lean();
  const double pitch = desired.pitch - p.hipPitchGain * tilt.pitch - p.hipPitchRateGain * tilt.pitchRate +
                       p.recoverLevelPitch * beyond(tilt.pitch, p.recoverTilt);
  const double roll = desired.roll - p.hipRollGain * tilt.roll - p.hipRollRateGain * tilt.rollRate +
                      p.recoverLevelRoll * beyond(tilt.roll, p.recoverTilt);
  const double xFactor = step_.translation.x() >= 0.0 ? p.xFactor : p.xFactorBack;
  const Vector2 shift = p.pendulumHeight / kGravity * acceleration_;
  const Matrix3 R_RL = tiltRotation(pitch, roll).transpose();
  for (const Side side : {Side::Left, Side::Right}) {
    const bool swings = mode_ != Mode::Standing && side != stance_;
    const Pose2 foot = X_TW * feet_[index(side)];
    Vector3 p_LS;
    p_LS.x() = foot.translation.x() + p.xOffset - xFactor * step_.translation.x() +
               p.comGainX * comOffset_.x() - p.accelerationShiftX * shift.x();
    p_LS.y() = foot.translation.y() - p.yFactor * step_.translation.y() + p.comGainY * comOffset_.y() -
               p.accelerationShiftY * shift.y();
    p_LS.z() = -height;
    double footPitch = p.footPitch;
    double footRoll = sideSign(side) * p.footRoll;
    if (swings) {
      p_LS.z() += p.zStep * liftShare;
      footPitch += p.swingPitch * liftShare - p.swingLevelGain * tilt.pitch;
      footRoll -= p.swingLevelGain * tilt.roll;
    } else if (mode_ != Mode::Standing) {
      p_LS.z() -= p.zPush * middle;
      footPitch += p.anklePitchGain * tilt.pitch + p.anklePitchRateGain * tilt.pitchRate;
      footRoll += p.ankleRollGain * tilt.roll + p.ankleRollRateGain * tilt.rollRate;
    }
    const Matrix3 R_LS = Eigen::AngleAxisd(foot.rotation, Vector3::UnitZ()).toRotationMatrix() *
                         tiltRotation(footPitch, footRoll);
    feet[index(side)].linear() = R_RL * R_LS;
    feet[index(side)].translation() = R_RL * p_LS;
  }
}

void WalkEngine::moveArms(model::JointArray& angles) const {
  const WalkParameters& p = parameters_;
  for (const Side side : {Side::Left, Side::Right}) {
    const double opposite = feet_[index(model::other(side))].translation.x();
    setArm(side, ArmAttitude{p.armPitch + p.armSwing * opposite, p.armYaw, p.armRoll, p.elbow}, angles);
  }
}

WalkEngine::Tilt WalkEngine::tiltError(const world::BodyState& body) const {
  const WalkParameters& p = parameters_;
  Tilt tilt;
  tilt.pitchRate = body.gyro.y();
  tilt.rollRate = body.gyro.x();
  const Lean desired = lean();
  tilt.pitch = body.pitch + p.tiltDelay * tilt.pitchRate - desired.pitch;
  tilt.roll = body.roll + p.tiltDelay * tilt.rollRate - desired.roll;
  return tilt;
}

// The centre of mass over the stance foot as commanded some cycles ago against that of the measured body.
void WalkEngine::measureComError(const world::BodyState& body, const model::JointArray& commanded) {
  const WalkParameters& p = parameters_;
  model::forwardKinematics(*model_, commanded, commandedBodies_);
  const auto [pitch, roll] = lean();
  comOffset_ = tiltRotation(pitch, roll) * model::centerOfMass(*model_, commandedBodies_);

  historyEnd_ = (historyEnd_ + 1) % kHistory;
  expectedCom_[historyEnd_] = comOverSole(*model_, commandedBodies_, stance_, pitch, roll);
  expectedStance_[historyEnd_] = stance_;
  expectedYaw_[historyEnd_] = torsoYaw();
  historySize_ = std::min(historySize_ + 1, kHistory);
  const auto delay = static_cast<std::size_t>(std::lround(p.comDelay / kCycleTime));
  if (delay >= historySize_) return;
  const std::size_t at = (historyEnd_ + kHistory - delay) % kHistory;
  trace_.torsoYaw = expectedYaw_[at];
  trace_.p_SComDesired = expectedCom_[at];
  trace_.p_SComMeasured = comOverSole(*model_, body.bodies, expectedStance_[at], body.pitch, body.roll);
  trace_.comError = (trace_.p_SComDesired - trace_.p_SComMeasured).head<2>().cwiseAbs().maxCoeff();
}

}  // namespace nonet::motion
