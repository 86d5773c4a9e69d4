// A page about a series of games, for people: result with its interval, when goals fall, differences, shots
// and passes, where ball and players were, kicks, players. One HTML file with inline SVG, nothing from
// outside.
#pragma once

#include <string>

namespace nonet::lab {

/// Reads the folder of a finished series (series.h) and writes FOLDER/report.html; returns its path. Throws
/// std::runtime_error: no series, not finished, damaged.
std::string writeSeriesReport(const std::string& folder);

}  // namespace nonet::lab
