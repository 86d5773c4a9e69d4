#include "nonet/motion/walk/balance.h"

#include <algorithm>
#include <cmath>

namespace nonet::motion {

namespace {

// A standing robot that leans more than this steps in place until it is calm.
constexpr double kStepTilt = 0.15;     // rad
constexpr double kUprightTilt = 0.08;  // rad; a stand takes care of what sways less

}  // namespace

Tilt tiltAgainst(const BalanceParameters& p, const Attitude& torso, const Vector3& gyro,
                 const Attitude& wanted) {
  Tilt tilt;
  tilt.pitchRate = gyro.y();
  tilt.rollRate = gyro.x();
  tilt.pitch = torso.pitch + p.tiltLookAhead * tilt.pitchRate - wanted.pitch;
  tilt.roll = torso.roll + p.tiltLookAhead * tilt.rollRate - wanted.roll;
  return tilt;
}

// err_norm and err_max of [MacAlpine 2012b]: a large error of the centre of mass shrinks the steps.
double stepShare(const BalanceParameters& p, double comError) {
  const double range = std::max(p.comErrorMost - p.comErrorNormal, 1e-6);
  return std::clamp((p.comErrorMost - comError) / range, 0.0, 1.0);
}

bool leansTooFar(const Tilt& tilt) {
  return tilt.largest() > kStepTilt;
}

bool isCalm(const BalanceParameters& p, const WalkMeasurement& measurement) {
  return measurement.tilt.largest() < kUprightTilt || measurement.comError < p.comErrorNormal;
}

Attitude steadied(const BalanceParameters& p, const Attitude& wanted, const Tilt& tilt) {
  return {.pitch = wanted.pitch - p.hipPitchGain * tilt.pitch - p.hipPitchRateGain * tilt.pitchRate,
          .roll = wanted.roll - p.hipRollGain * tilt.roll - p.hipRollRateGain * tilt.rollRate};
}

Attitude ankleTurn(const BalanceParameters& p, const Tilt& tilt) {
  return {.pitch = p.anklePitchGain * tilt.pitch + p.anklePitchRateGain * tilt.pitchRate,
          .roll = p.ankleRollGain * tilt.roll + p.ankleRollRateGain * tilt.rollRate};
}

Attitude swingLevel(const BalanceParameters& p, const Tilt& tilt) {
  return {.pitch = p.swingLevelGain * tilt.pitch, .roll = p.swingLevelGain * tilt.roll};
}

Vector2 landingShift(const BalanceParameters& p, const Tilt& tilt) {
  return {p.stepPitchGain * tilt.pitch + p.stepPitchRateGain * tilt.pitchRate,
          -(p.stepRollGain * tilt.roll + p.stepRollRateGain * tilt.rollRate)};
}

void CommandHistory::add(const Command& command) {
  last_ = (last_ + 1) % kMost;
  commands_[last_] = command;
  size_ = std::min(size_ + 1, kMost);
}

const CommandHistory::Command* CommandHistory::measuredNow() const {
  if (size_ <= kDelay) return nullptr;
  return &commands_[(last_ + kMost - kDelay) % kMost];
}

}  // namespace nonet::motion
