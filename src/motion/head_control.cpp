#include "nonet/motion/head_control.h"

#include <algorithm>
#include <cmath>

#include "nonet/math/angle.h"

namespace nonet::motion {

using model::index;
using model::JointId;

namespace {

// rad to either side of straight behind, where the head keeps to the side on which it is.
constexpr double kBehindMargin = 0.2;

double onTheSameSide(double pan, double present) {
  const bool behind = std::abs(pan) > kPi - kBehindMargin;
  return behind && pan * present < 0.0 ? std::copysign(kPi, present) : pan;
}

}  // namespace

HeadControl::HeadControl(const model::RobotModel& model, const HeadParameters& parameters)
    : model_(&model), parameters_(parameters) {}

void HeadControl::update(const world::BodyState& body, const HeadRequest& request, JointTargets& targets) {
  if (!active_) {
    pan_ = body.joints[index(JointId::Head1)];
    tilt_ = -body.joints[index(JointId::Head2)];
    active_ = true;
  }
  switch (request.kind) {
    case HeadRequest::Kind::Look:
      scanning_ = false;
      follow(request.pan, request.tilt, body.cycleTime, targets);
      return;
    case HeadRequest::Kind::Point: {
      scanning_ = false;
      const Vector3 p_CP = request.p_RP - model::cameraPose(body.bodies).translation();
      const double pan = std::atan2(p_CP.y(), p_CP.x());
      const double tilt = std::atan2(-p_CP.z(), p_CP.head<2>().norm());
      follow(onTheSameSide(pan, pan_), std::min(tilt, parameters_.nearTilt), body.cycleTime, targets);
      return;
    }
    case HeadRequest::Kind::Scan:
      follow(scanAngle(body.cycleTime), parameters_.scanTilt, body.cycleTime, targets);
      return;
  }
}

// A sine, entered at the angle at which the head is.
double HeadControl::scanAngle(double time) {
  const double amplitude = std::max(parameters_.scanPan, 1e-3);
  if (!scanning_) {
    scanPhase_ = std::asin(std::clamp(pan_ / amplitude, -1.0, 1.0)) / (2.0 * kPi);
    scanning_ = true;
  }
  scanPhase_ += time / parameters_.scanPeriod;
  scanPhase_ -= std::floor(scanPhase_);
  return amplitude * std::sin(2.0 * kPi * scanPhase_);
}

void HeadControl::follow(double pan, double tilt, double time, JointTargets& targets) {
  const auto& panJoint = model_->joint(JointId::Head1);
  const auto& tiltJoint = model_->joint(JointId::Head2);
  const double step = parameters_.maxSpeed * time;
  // Half a step away from the stops: a joint driven into its stop bounces without end (server facts 2.4).
  constexpr double kStopMargin = 0.06;
  pan = std::clamp(pan, panJoint.low + kStopMargin, panJoint.high - kStopMargin);
  tilt = std::clamp(tilt, -tiltJoint.high + kStopMargin, -tiltJoint.low - kStopMargin);
  pan_ += std::clamp(pan - pan_, -step, step);
  tilt_ += std::clamp(tilt - tilt_, -step, step);
  targets.angles[index(JointId::Head1)] = pan_;
  targets.angles[index(JointId::Head2)] = -tilt_;
  targets.stiffness[index(JointId::Head1)] = 1.0;
  targets.stiffness[index(JointId::Head2)] = 1.0;
}

}  // namespace nonet::motion
