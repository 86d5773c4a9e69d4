// How far, how straight and how soon the robot kicks, kick by kick: seeded kicks with the whole approach from
// ten sides (lab/trial/kick_trial.h), as a table, as JSON and as a picture of the balls' ways.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "nonet/lab/common/progress.h"
#include "nonet/lab/trial/kick_trial.h"

namespace nonet::lab {

struct KickReportSettings {
  agent::AgentSettings agent;
  std::string kick = "all";  // name, "all", or "any": what motion chooses by itself
  int trials = 100;          // of each kick
  double start = 0.5;        // m from the ball
  double rolling = 0.0;      // m/s, the fastest that the ball rolls at the begin
  double pushed = 0.0;       // m/s, how fast it rolls towards the target at the begin
  double passed = 0.0;       // m/s, how fast it comes as a pass at the begin, to roll out before the robot
  double distance = 10.0;    // m, how far the ball is wanted to go
  bool stops = false;        // and no farther: motion chooses as for a pass
  std::uint64_t seed = 1;
  int threads = 0;  // 0: all processors; the result does not depend on it
  TrialProgress progress{};
  std::optional<ServerAddress> server{};  // kicks there, one after the other, instead of in process
};

/// A figure over many kicks.
struct KickFigure {
  double mean = 0.0;
  double median = 0.0;
  double p10 = 0.0;  // a tenth of the kicks is below
};

struct KickMeasures {
  std::string name;
  int trials = 0;
  KickFigure distance;           // m towards the target; a miss counts with what it made
  KickFigure reached;            // share of the distance asked for
  KickFigure height;             // m, of the ball's centre a metre from where it lay
  KickFigure apex;               // m, of the ball's centre where it is highest, of the kicks that hit
  KickFigure apexAt;             // m from where the ball lay to there
  double apexSpread = 0.0;       // m, standard deviation of heights
  KickFigure directionError;     // rad, of the kicks that hit
  KickFigure time;               // s until contact, of the kicks that hit
  double under2m = 0.0;          // share of all
  double withinTen = 0.0;        // share of all that went within 10 degrees of the target
  double falls = 0.0;            // share of all
  double misses = 0.0;           // share of all
  double selfCollisions = 0.0;   // share of all in which the referee froze limbs
  std::optional<double> clears;  // of a chip: share of all that were high enough and came down soon enough
  std::vector<Kick> kicks;
};

/// Names of the kicks that this robot can do. Throws motion::SkillError.
std::vector<std::string> kickNames(const agent::AgentSettings& agent);

/// One entry per kick. Throws std::runtime_error for a kick that this robot cannot do.
std::vector<KickMeasures> measureKicks(const KickReportSettings& settings);
std::string kickReportTable(const std::vector<KickMeasures>& report);
std::string kickReportJson(const std::vector<KickMeasures>& report, const KickReportSettings& settings);
/// The balls' ways from above and from the side.
std::string kickReportSvg(const KickMeasures& kick, const KickReportSettings& settings);

}  // namespace nonet::lab
