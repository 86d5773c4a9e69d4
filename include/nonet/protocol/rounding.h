// What printing does to a number. The simulation, when it runs in the same process as the agent, passes
// values without text; rounding them here gives the same doubles, to the last bit, that the text would have
// given.
#pragma once

#include <cmath>
#include <limits>

#include "nonet/math/angle.h"

namespace nonet::protocol {

/// The value of strtod(printf("%.2f", value)), which is what a sense message does to a number (server facts
/// 1.5). 100 * value is exact in double (24 + 5 bits), nearbyint breaks ties to even as printf does, and the
/// quotient is rounded correctly as strtod's result is. A NaN keeps its sign only, as in "-nan".
inline double roundToWire(float value) {
  if (std::isnan(value)) {
    return std::copysign(std::numeric_limits<double>::quiet_NaN(), static_cast<double>(value));
  }
  return std::nearbyint(static_cast<double>(value) * 100.0) / 100.0;
}

/// Degrees read from the wire, in rad. The parser uses this expression and no other.
inline double degreesFromWire(double degrees) {
  return toRadians(degrees);
}

/// An angle (or rate) in degrees as the server holds it, in rad as the agent gets it.
inline double radiansOnWire(float degrees) {
  return degreesFromWire(roundToWire(degrees));
}

/// The value of strtod(printf("%.6g", value)), which is what writeEffectors() and a reader do to a number.
double roundToSixDigits(double value);

}  // namespace nonet::protocol
