// Makes a kick send the ball where it should go (nonet kick straighten): measures how the ball's direction
// follows what the kick is told when it begins (motion::KickInputs) and how a turn of its foot moves it, and
// sets the skill's parameters `yaw`, `yawAhead`, `yawAside`, `yawTurn`, `yawPaceAhead` and `yawPaceAside`
// (skills/README.md) so that it follows no longer. What is common to all kicks becomes `veer` of its head.
#pragma once

#include <string>
#include <vector>

#include "nonet/lab/optimize/kick_fit.h"
#include "nonet/lab/reports/kick_report.h"

namespace nonet::lab {

/// What the foot can turn with: the inputs of a kick but the distance.
constexpr int kTurningInputs = motion::kDistanceInput;
using TurningInputs = Eigen::Matrix<double, kTurningInputs, 1>;

/// One kick, as the left foot does it.
struct DirectionSample {
  TurningInputs inputs = TurningInputs::Zero();  // m, m, rad, m/s, m/s
  double direction = 0.0;                        // of the ball to the left of where it should go, rad
};

struct DirectionFit {
  TurningInputs mean = TurningInputs::Zero();    // of the inputs
  TurningInputs slopes = TurningInputs::Zero();  // rad for each m, m, rad, m/s, m/s
  double deviation = 0.0;                        // rad, of the direction
  double rest = 0.0;                             // rad, of what the inputs do not tell
};

/// How the direction follows the inputs, by ridge regression. Kicks farther than 0.1 rad from the median are
/// left out: they stumbled. Throws std::runtime_error for fewer than twenty others.
DirectionFit fitDirection(const std::vector<DirectionSample>& samples);

struct DirectionFigures {
  double median = 0.0;      // rad, to the left
  double beyondFive = 0.0;  // share of the kicks more than five degrees off
};

struct StraightenedKick {
  std::string kick;
  int robotType = 0;
  double authority = 0.0;  // how far the ball's way turns with the foot, rad/rad
  bool turns = false;      // far enough: otherwise only `veer` was set
  DirectionFit fit;        // before
  KickMeasures before;     // on kicks that the values were not made from
  KickMeasures after;
  DirectionFigures directionBefore;
  DirectionFigures directionAfter;
  std::vector<FittedParameter> parameters;
  bool better = false;  // straighter, and as good in all else
};

/// Settings as for a report of this one kick; up to seven times so many kicks are measured. Throws
/// std::runtime_error: there is no such kick for this type, or it has none of the parameters.
StraightenedKick straightenKick(const KickReportSettings& settings);

/// Before and after, for people.
std::string straightenedTable(const StraightenedKick& result);
/// The parameters as a file that overlays those in force.
std::string straightenedToml(const StraightenedKick& result);

}  // namespace nonet::lab
