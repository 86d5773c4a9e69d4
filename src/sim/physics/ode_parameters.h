// How the server sets ODE up (server facts 2.4, 3.1). What its scripts and code set passes through 32-bit
// floats; the rest is ODE's default.
#pragma once

namespace nonet::sim {

inline constexpr float kGravity = 9.81F;  // m/s^2, downwards
inline constexpr float kWorldCfm = 0.00001F;
inline constexpr double kWorldErp = 0.2;        // ODE's default
inline constexpr float kSurfaceLayer = 0.001F;  // m, depth of a contact that is not pushed out
inline constexpr float kMotorTorque = 10.0F;    // N m, the greatest
inline constexpr float kMotorCfm = 1e-8F;       // also of a joint's stops
inline constexpr float kStopErp = 0.8F;
inline constexpr float kStopBounce = 1.0F;
inline constexpr float kMotorFudgeFactor =
    1e-5F;                                   // share of the torque of a motor that leads away from a stop
inline constexpr int kStepsUntilSleep = 10;  // ODE's default: idle steps before a body falls asleep

}  // namespace nonet::sim
