#include "nonet/motion/joint_control.h"

#include <algorithm>
#include <cmath>

#include "nonet/protocol/rounding.h"

namespace nonet::motion {

JointControl::JointControl(const model::RobotModel& model, const ControlParameters& parameters)
    : model_(&model), parameters_(parameters) {
  for (const model::JointSpec& spec : model.joints()) {
    // The server clamps in 32 bits.
    joints_[model::index(spec.id)] = {spec.low + parameters.stopMargin, spec.high - parameters.stopMargin,
                                      spec.low, spec.high,
                                      static_cast<double>(static_cast<float>(spec.maxSpeed))};
  }
}

void JointControl::reset() {
  underWay_.fill(0.0);
  integral_.fill(0.0);
  lastError_.fill(0.0);
  hasLastError_ = false;
}

void JointControl::update(const world::BodyState& body, const JointTargets& targets,
                          protocol::Effectors& effectors) {
  // Messages that did not arrive were not answered: whatever the last command did in the meantime is in the
  // measured angle, and it stays in force for the next step too. Only what counts cycles needs their number.
  const double cycles = std::max(1.0, std::round(body.cycleTime / kCycleTime));
  for (const model::JointSpec& spec : model_->joints()) {
    const std::size_t i = model::index(spec.id);
    const Joint& joint = joints_[i];
    const double predicted = body.joints[i] + underWay_[i] * kCycleTime;
    double speed = 0.0;
    if (std::isfinite(targets.angles[i]) && targets.stiffness[i] > 0.0) {
      const double target = std::clamp(targets.angles[i], joint.low, joint.high);
      speed = targets.stiffness[i] * speedFor(i, predicted, target - predicted, cycles);
    } else {
      integral_[i] = 0.0;
      lastError_[i] = 0.0;
    }
    effectors.setSpeed(spec.id, protocol::roundToSixDigits(speed));
    // A joint that will be at or beyond a stop when the command arrives keeps its old one (server facts 2.4).
    if (predicted > joint.lowStop && predicted < joint.highStop) {
      const auto received = static_cast<float>(effectors.speeds[i]);
      underWay_[i] = std::clamp(static_cast<double>(received), -joint.maxSpeed, joint.maxSpeed);
    }
  }
  hasLastError_ = true;
}

double JointControl::speedFor(std::size_t i, double predicted, double error, double cycles) {
  const Joint& joint = joints_[i];
  const double change = hasLastError_ ? (error - lastError_[i]) / cycles : 0.0;
  lastError_[i] = error;
  const double sum = integral_[i] + error * cycles;
  const double wanted =
      (parameters_.proportional * error + parameters_.integral * sum + parameters_.derivative * change) /
      kCycleTime;

  // What one cycle may do: the joint's own speed, and no further than to the margin before the stops.
  const double low = std::max(-joint.maxSpeed, std::min(0.0, (joint.low - predicted) / kCycleTime));
  const double high = std::min(joint.maxSpeed, std::max(0.0, (joint.high - predicted) / kCycleTime));
  const double speed = std::clamp(wanted, low, high);
  // The integral stands still while the speed is at a limit and the error pushes on (no wind-up).
  if (speed == wanted || (speed - wanted) * error > 0.0) integral_[i] = sum;
  return speed;
}

}  // namespace nonet::motion
