#include "nonet/motion/walk/gait.h"

#include <algorithm>
#include <cmath>

namespace nonet::motion {

using model::Side;

namespace {

// Steps smaller than this are none: a stand may follow.
constexpr double kStepTolerance = 5e-3;  // m
constexpr double kTurnTolerance = 0.03;  // rad
constexpr int kStepsBeforeStand = 2;     // in place, so that both feet have come home
constexpr int kStepsBeforeSoon = 1;
constexpr int kMostStepsInPlace = 25;  // then stand even with an error

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

// A step in several directions at once: within the unit ball of a norm whose unit is the largest step.
Pose2 withinLargest(const GaitParameters& p, const Pose2& step) {
  const double maxX = step.translation.x() >= 0.0 ? p.maxStepX : p.maxStepXBack;
  const auto share = [](double value, double most) { return most > 0.0 ? std::abs(value) / most : 1e3; };
  const double e = p.combineExponent;
  const double norm = std::pow(std::pow(share(step.translation.x(), maxX), e) +
                                   std::pow(share(step.translation.y(), p.maxStepY), e) +
                                   std::pow(share(step.rotation, p.maxStepTheta), e),
                               1.0 / e);
  return norm > 1.0 ? scaled(step, 1.0 / norm) : step;
}

}  // namespace

void Gait::reset() {
  state_.standing = true;
  state_.phase = 1.0;
  state_.step = filteredStep_ = odometryStep_ = Pose2{};
  state_.acceleration = Vector2::Zero();
  feetPlaced_ = false;
}

void Gait::update(const GaitParameters& parameters, const GaitInput& input) {
  if (!feetPlaced_) placeFeet(parameters);
  state_.stepDuration = stepDuration(parameters);
  updateStepSize(parameters, input);
  advancePhase(input);
  moveFrame(input.cycleTime);
}

void Gait::placeFeet(const GaitParameters& parameters) {
  for (const Side side : {Side::Left, Side::Right}) {
    const double sign = sideSign(side);
    feet_[index(side)] = Pose2(0.0, 0.5 * sign * parameters.footSeparation, sign * parameters.footYaw);
  }
  swingStart_ = foot(model::other(state_.stance));
  feetPlaced_ = true;
}

// Whole cycles: a gait of three cycles is regular, one of 3.1 would limp every tenth step.
double Gait::stepDuration(const GaitParameters& parameters) {
  return kCycleTime * std::max(1.0, std::round(parameters.stepDuration / kCycleTime));
}

// The proportional filter of [MacAlpine 2012b, walk engine], with a bound on the change.
void Gait::updateStepSize(const GaitParameters& p, const GaitInput& input) {
  const double cycles = input.cycleTime / kCycleTime;
  const Pose2 desired =
      withinLargest(p, input.command.walk ? scaled(input.command.speed, state_.stepDuration) : Pose2{});
  const auto change = [&](double value, double goal, double delta, double most) {
    const bool shrinks = value * (goal - value) < 0.0;
    const double factor = shrinks ? p.brake : 1.0;
    return approach(value, goal, shareAfter(cycles, factor * delta), factor * most * cycles);
  };
  Vector2& way = filteredStep_.translation;
  double& turn = filteredStep_.rotation;
  way.x() = change(way.x(), desired.translation.x(), p.deltaStepX, p.maxChangeX);
  way.y() = change(way.y(), desired.translation.y(), p.deltaStepY, p.maxChangeY);
  turn = approach(turn, desired.rotation, shareAfter(cycles, p.deltaStepTheta), p.maxChangeTheta * cycles);
  const double leastStep = input.command.soon ? p.stopStep : kStepTolerance;
  const double leastTurn = input.command.soon ? p.stopTurn : kTurnTolerance;
  if (!input.command.walk && way.cwiseAbs().maxCoeff() < leastStep && std::abs(turn) < leastTurn) {
    filteredStep_ = Pose2{};
  }
  const Vector2 before = state_.step.translation;
  state_.step = scaled(filteredStep_, input.stepShare);
  // Who stumbles speeds up anew afterwards, instead of leaping back to the full step.
  if (input.stumbles) filteredStep_ = state_.step;
  followPush(p, input.push);
  updateAcceleration(p, state_.step.translation - before, cycles);
}

// Who is pushed stays over its feet only if these come along at once.
void Gait::followPush(const GaitParameters& p, const Push& push) {
  if (state_.standing) return;
  const Vector2 fastest(p.maxStepXBack, p.maxStepY);
  const auto follow = [&](int axis, double speed) {
    const double step = std::clamp(speed * state_.stepDuration, -fastest[axis], fastest[axis]);
    double& present = state_.step.translation[axis];
    if (std::abs(step) > std::abs(present) || step * present < 0.0)
      present = filteredStep_.translation[axis] = step;
  };
  if (push.forward) follow(0, *push.forward);
  if (push.left) follow(1, *push.left);
}

// In the walk frame: the change of speed, and that of its direction in a curve.
void Gait::updateAcceleration(const GaitParameters& p, const Vector2& stepChange, double cycles) {
  if (cycles <= 0.0) return;  // the first message of all
  const double turnRate = state_.step.rotation / state_.stepDuration;
  const Vector2 speed = state_.step.translation / state_.stepDuration;
  const Vector2 commanded =
      stepChange / (state_.stepDuration * kCycleTime * cycles) + turnRate * Vector2(-speed.y(), speed.x());
  state_.acceleration += shareAfter(cycles, p.accelerationFilter) * (commanded - state_.acceleration);
}

void Gait::advancePhase(const GaitInput& input) {
  if (state_.standing) {
    if (!input.command.walk && !input.leans) return;
    // The first step is made by the foot on the side of the motion, or of the lean.
    const double toLeft = input.command.walk
                              ? input.command.speed.translation.y() + 0.1 * input.command.speed.rotation
                              : input.leanToLeft;
    beginStep(toLeft >= 0.0 ? Side::Right : Side::Left);
    stepsDone_ = 0;
    stepsInPlace_ = 0;
  } else if (state_.phase >= 1.0 - 1e-6) {
    ++stepsDone_;
    const bool inPlace =
        !input.command.walk && filteredStep_.translation.isZero() && filteredStep_.rotation == 0.0;
    stepsInPlace_ = inPlace ? stepsInPlace_ + 1 : 0;
    const int needed = input.command.soon ? kStepsBeforeSoon : kStepsBeforeStand;
    if (stepsInPlace_ > needed && (input.calm || stepsInPlace_ > kMostStepsInPlace)) {
      state_.standing = true;
      state_.step = Pose2{};
      return;
    }
    beginStep(model::other(state_.stance));
  }
  state_.standing = false;
  state_.phase = std::min(1.0, state_.phase + input.cycleTime / state_.stepDuration);
}

void Gait::beginStep(Side stance) {
  state_.stance = stance;
  swingStart_ = foot(model::other(stance));
  state_.phase = 0.0;
}

// The walk frame moves steadily; what stands on the ground moves backwards in it.
void Gait::moveFrame(double cycleTime) {
  odometryStep_ = state_.standing ? Pose2{} : scaled(state_.step, cycleTime / state_.stepDuration);
  const Pose2 back = odometryStep_.inverse();
  for (Pose2& foot : feet_) foot = back * foot;
  swingStart_ = back * swingStart_;
}

// Half a step ahead of where the walk frame will be then; the other half follows while the foot is stance
// foot.
Pose2 Gait::landing(const GaitParameters& p, double torsoYaw) const {
  const Pose2& step = state_.step;
  const double sign = sideSign(model::other(state_.stance));
  const double wider =
      p.widthPerTurn * std::abs(step.rotation) + p.widthPerSideStep * std::abs(step.translation.y());
  const double side = sign * (0.5 * p.footSeparation + wider);
  const double outwards = sign * (p.footYaw + p.footYawPerTurn * std::abs(step.rotation) +
                                  p.footYawPerTorsoYaw * std::abs(torsoYaw));
  return scaled(step, 1.0 - state_.phase) *
         Pose2(0.5 * step.translation.x(), side + 0.5 * step.translation.y(), 0.5 * step.rotation + outwards);
}

void Gait::moveSwingFoot(const GaitParameters& p, const Pose2& landing) {
  const double moved = progress(state_.phase, p.swingBegin, p.swingLength, p.swingStraightness);
  Pose2& foot = feet_[index(model::other(state_.stance))];
  foot.translation = (1.0 - moved) * swingStart_.translation + moved * landing.translation;
  foot.rotation = swingStart_.rotation + moved * wrapAngle(landing.rotation - swingStart_.rotation);
}

double Gait::lift(const GaitParameters& p) const {
  const double u = (state_.phase - p.liftBegin) / p.liftLength;
  if (state_.standing || u < 0.0 || u > 1.0) return 0.0;
  const double share = stepsDone_ == 0 ? p.startLift : 1.0;
  return share * progress(1.0 - std::abs(2.0 * u - 1.0), 0.0, 1.0, p.liftStraightness);
}

}  // namespace nonet::motion
