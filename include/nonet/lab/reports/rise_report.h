// How reliably and how fast the robot gets up: seeded falls to the front, the back and the side, on the exact
// in-process physics with the real motion code.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "nonet/lab/common/progress.h"
#include "nonet/lab/trial/rise_trial.h"

namespace nonet::lab {

struct RiseReportSettings {
  TrialSettings setup;
  int falls = 100;  // of each kind
  std::uint64_t seed = 1;
  int threads = 0;  // 0: all processors; the result does not depend on it
  TrialProgress progress{};
};

struct RiseStatistics {
  int falls = 0;
  int firstTry = 0;
  int risen = 0;
  int selfCollisions = 0;  // rises in which the referee would have frozen limbs
  double median = 0.0;     // s, of those that rose
  double slowest = 0.0;    // s
};

struct RiseReport {
  std::array<RiseStatistics, kFallKindCount> kinds{};
};

RiseReport measureRising(const RiseReportSettings& settings);
std::string riseReportTable(const RiseReport& report);
std::string riseReportJson(const RiseReport& report);

}  // namespace nonet::lab
