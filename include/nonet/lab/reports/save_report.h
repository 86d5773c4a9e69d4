// How many shots the goalie saves: seeded shots that would be goals, rolling and flying, at the whole agent
// (lab/trial/save_trial.h), as a table, as JSON and as a picture.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "nonet/lab/common/progress.h"
#include "nonet/lab/trial/save_trial.h"

namespace nonet::lab {

struct SaveReportSettings {
  agent::AgentSettings goalie;
  int trials = 500;          // of each kind
  bool quickSolver = false;  // of the trials; what counts as a shot is always found on the exact world
  int challenge =
      0;  // above 0: so many rounds of the same twelve shots instead, as in the league's challenge
  std::uint64_t seed = 1;
  int threads = 0;  // 0: all processors; the result does not depend on it
  TrialProgress progress{};
};

struct SaveStatistics {
  int trials = 0;
  int saved = 0;
  int touched = 0;
  int falls = 0;
  int upAgain = 0;  // of the falls
  int ownGoals = 0;
  int cleared = 0;        // of the saved
  double riseTime = 0.0;  // s on the ground in the mean over the falls

  double savedShare() const { return trials == 0 ? 0.0 : static_cast<double>(saved) / trials; }
};

struct SaveReport {
  SaveStatistics rolling;
  SaveStatistics flying;
  SaveStatistics all;
  std::vector<Save> saves;
};

/// The twelve shots of a challenge: six rolling, six flying, in turn.
std::vector<Shot> challengeShots(std::uint64_t seed);

SaveStatistics saveStatistics(const std::vector<Save>& saves);
SaveReport measureSaves(const SaveReportSettings& settings);
std::string saveReportTable(const SaveReport& report);
std::string saveReportJson(const SaveReport& report, const SaveReportSettings& settings);
/// The shots and where they were stopped, from above and seen from the field.
std::string saveReportSvg(const SaveReport& report, const SaveReportSettings& settings);

}  // namespace nonet::lab
