// A page about a run, for people: fitness, step size and the way of each parameter, as SVG in one HTML file.
#pragma once

#include <string>

namespace nonet::lab {

/// Reads the folder of a run (finished or not) and writes FOLDER/report.html; returns its path. Throws
/// std::runtime_error.
std::string writeOptimizationReport(const std::string& folder, const std::string& dataFolder);

}  // namespace nonet::lab
