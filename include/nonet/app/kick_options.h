// Options of the commands that measure kicks.
#pragma once

#include <CLI/CLI.hpp>

#include "nonet/lab/reports/kick_report.h"

namespace nonet::app {

/// --start, --rolling, --distance and --threads. As long as the settings.
void addKickOptions(CLI::App& command, lab::KickReportSettings& settings);

}  // namespace nonet::app
