// Angles: conversion at the edges, wrapping, differences.
#pragma once

#include <cmath>

#include "nonet/math/types.h"

namespace nonet {

constexpr double toRadians(double degrees) {
  return degrees * (kPi / 180.0);
}
constexpr double toDegrees(double radians) {
  return radians * (180.0 / kPi);
}

namespace literals {
constexpr double operator""_deg(long double degrees) {
  return toRadians(static_cast<double>(degrees));
}
constexpr double operator""_deg(unsigned long long degrees) {
  return toRadians(static_cast<double>(degrees));
}
}  // namespace literals

/// The same angle in (-pi, pi].
inline double wrapAngle(double angle) {
  const double wrapped = std::remainder(angle, 2.0 * kPi);
  return wrapped <= -kPi ? wrapped + 2.0 * kPi : wrapped;
}

/// Signed turn from `from` to `to`, in (-pi, pi].
inline double angleDifference(double to, double from) {
  return wrapAngle(to - from);
}

}  // namespace nonet
