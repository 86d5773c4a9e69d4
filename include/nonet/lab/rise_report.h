// How reliably and how fast the robot gets up: seeded falls to the front, the back and the side, on the exact
// in-process physics with the real motion code.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "nonet/lab/robot_trial.h"

namespace nonet::lab {

enum class FallKind : std::uint8_t { Front, Back, Side };
inline constexpr std::size_t kFallKindCount = 3;

struct RiseReportSettings {
  TrialSetup setup;
  int falls = 100;  // of each kind
  std::uint64_t seed = 1;
  int threads = 0;  // 0: all processors; the result does not depend on it
};

struct Rise {
  bool fell = false;    // the robot came to lie as wanted
  bool stands = false;  // in the end
  int attempts = 0;
  double time = 0.0;  // from lying (dives: from their end) to a stand that lasts, s
};

struct RiseStatistics {
  int falls = 0;
  int firstTry = 0;
  int risen = 0;
  double median = 0.0;   // s, of those that rose
  double slowest = 0.0;  // s
};

struct RiseReport {
  std::array<RiseStatistics, kFallKindCount> kinds{};
};

/// Front and back: the robot is tipped over while it stands or walks, in a random direction about the wanted
/// one, with random joint angles. Side: the goalie's dive. The same seed always gives the same fall.
Rise fallAndRise(const TrialSetup& setup, FallKind kind, std::uint64_t seed);

RiseReport measureRising(const RiseReportSettings& settings);
std::string riseReportTable(const RiseReport& report);
std::string riseReportJson(const RiseReport& report);

}  // namespace nonet::lab
