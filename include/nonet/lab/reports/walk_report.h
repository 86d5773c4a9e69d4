// What a parameter set walks like: speeds in 16 directions and turning, from a stand and steady, falls, with
// confidence intervals. Measured on the exact in-process physics with the real motion code (robot_trial.h);
// the robot steers by its true pose with the noise of a localization (about 25 mm, docs/references.md).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "nonet/lab/common/progress.h"
#include "nonet/lab/common/statistics.h"
#include "nonet/lab/trial/measured_robot.h"
#include "nonet/lab/trial/target_course.h"

namespace nonet::lab {

inline constexpr int kWalkDirections = 16;  // every 22.5 degrees, counter-clockwise from forward

struct WalkReportSettings {
  TrialSettings setup;
  int trials = 10;  // per measure
  std::uint64_t seed = 1;
  int courses = 0;                      // obstacle courses of a minute to walk (target_course.h), in process
  int threads = 0;                      // 0: all processors; the result does not depend on it
  double positionNoise = 0.025;         // m, standard deviation
  double headingNoise = 0.02;           // rad
  std::optional<ServerAddress> server;  // measure there, one walk after the other, instead of in process
  TrialProgress progress{};
};

struct WalkReport {
  Estimate forwardTenSeconds;                      // m/s over ten seconds from a stand, towards a far target
  std::array<Estimate, kWalkDirections> steady{};  // m/s
  std::array<Estimate, kWalkDirections> fromStand{};  // m/s over the first three seconds
  std::array<int, kWalkDirections> fallsByDirection{};
  Estimate turn;           // rad/s, both senses together
  Estimate odometryError;  // share of the distance walked forward
  int robotType = 0;
  int falls = 0;
  int trials = 0;  // walks in all
  CourseSummary course;
};

WalkReport measureWalk(const WalkReportSettings& settings);

std::string walkReportTable(const WalkReport& report);
/// One JSON object with the keys forward_10s_mps, forward_mps, backward_mps, sideways_mps, turn_degps (each
/// with mean and ci95), falls, trials, and the directions.
std::string walkReportJson(const WalkReport& report);
/// Polar plot of the speeds.
std::string walkReportSvg(const WalkReport& report);

/// A plot of some steps: desired and measured centre of mass, feet, tilt of the torso.
std::string walkTraceSvg(const TrialSettings& setup, const Pose2& velocity, double seconds);

}  // namespace nonet::lab
