// A series from begin to end with its progress on the console: what `nonet series` and `nonet table` share.
#pragma once

#include <memory>
#include <string>

#include "nonet/app/console.h"
#include "nonet/lab/match/series.h"

namespace nonet::app {

struct SeriesRun {
  std::unique_ptr<lab::Series> series;
  lab::SeriesResult result;
  bool complete = false;  // otherwise stopped by SIGINT or SIGTERM
};

/// Begins or resumes the series in the folder and plays what is open, `jobs` games at a time (0: one per
/// core; on a server of others always one). Sets date, version and fingerprints of the settings. `title`
/// begins the progress line. Throws std::runtime_error.
SeriesRun playSeries(lab::SeriesSettings settings, const std::string& folder, int jobs,
                     const std::string& dataFolder, Console& console, const std::string& title);

/// What the user typed, for the reader of a result.
std::string commandLine();

}  // namespace nonet::app
