// How far and how straight the robot kicks: seeded kicks from the stand or out of the last steps to the ball,
// the ball some centimetres beside its nominal place, on the exact in-process physics with the real motion
// code.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "nonet/lab/trial/kick_trial.h"

namespace nonet::lab {

struct KickReportSettings {
  TrialSetup setup;
  int kicks = 50;  // with each foot
  KickFrom from = KickFrom::Stand;
  std::uint64_t seed = 1;
  int threads = 0;  // 0: all processors; the result does not depend on it
};

struct KickStatistics {
  int kicks = 0;
  int falls = 0;
  int misses = 0;
  double distance = 0.0;        // m in the wanted direction, mean; misses count
  double ci95 = 0.0;            // half width, m
  double directionError = 0.0;  // rad, mean of the magnitudes, of the kicks that hit
  double withinTen = 0.0;       // share of all kicks within 10 degrees
  double duration = 0.0;        // s, mean
};

using KickReport = std::array<KickStatistics, 2>;  // by model::Side

KickReport measureKicks(const KickReportSettings& settings);
std::string kickReportTable(const KickReport& report);
std::string kickReportJson(const KickReport& report);

}  // namespace nonet::lab
