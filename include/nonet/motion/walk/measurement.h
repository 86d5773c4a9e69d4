// What the layers of the walk feel: the typed input of all feedback.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "nonet/math/types.h"

namespace nonet::motion {

/// Of the torso or of a sole against the ground, rad: pitch forward (toe down), roll to the right.
struct Attitude {
  double pitch = 0.0;
  double roll = 0.0;
};

/// First rolled, then pitched.
inline Matrix3 rotationOf(const Attitude& attitude) {
  return (Eigen::AngleAxisd(attitude.pitch, Vector3::UnitY()) *
          Eigen::AngleAxisd(attitude.roll, Vector3::UnitX()))
      .toRotationMatrix();
}

/// How far the torso leans beyond what posture asks for, rad, and how fast it turns, rad/s.
struct Tilt {
  double pitch = 0.0;
  double pitchRate = 0.0;
  double roll = 0.0;
  double rollRate = 0.0;

  double largest() const { return std::max(std::abs(pitch), std::abs(roll)); }
};

/// How fast something pushes the robot back and aside while it leans there; nothing along an axis: no push.
struct Push {
  std::optional<double> forward{};  // m/s, negative
  std::optional<double> left{};     // m/s
};

struct WalkMeasurement {
  Tilt tilt;
  double comError = 0.0;  // of the centre of mass over the stance foot against the command, m
  double torsoYaw = 0.0;  // of the measured torso in the walk frame, as commanded for it, rad
};

}  // namespace nonet::motion
