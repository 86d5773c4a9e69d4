#include "nonet/app/kick_options.h"

#include "nonet/app/option_checks.h"

namespace nonet::app {

void addKickOptions(CLI::App& command, lab::KickReportSettings& settings) {
  command.add_option("--start", settings.start, "Distance from which the robot comes, m")
      ->check(CLI::Range(0.2, 5.0));
  command.add_option("--rolling", settings.rolling, "Fastest speed of the ball at the begin, m/s")
      ->check(CLI::Range(0.0, 3.0));
  command.add_option("--distance", settings.distance, "How far the ball should go, m")
      ->check(CLI::Range(0.5, 25.0));
  command.add_option("--threads", settings.threads, "Threads, 0 = all processors")->check(threadCount());
}

}  // namespace nonet::app
