#include "nonet/sim/settings/settings.h"

#include <algorithm>

#include <fmt/format.h>

#include "nonet/config/assignment.h"
#include "nonet/config/nearest.h"
#include "nonet/sim/settings/declarations.h"

namespace nonet::sim {

namespace {

/// A settings file: the names as they are, or in a [Soccer] table, as the server's script has them.
struct SettingsFile {
  Settings settings;
  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    Settings::describe(self.settings, visit);
    visit.group("Soccer", self.settings);
  }
};

// The ball's centre is in a goal while the whole ball is: that space is as much smaller than the goal as the
// ball is wide, and physics cannot have one of no size.
void checkGoals(const Settings& s) {
  const double diameter = 2.0 * s.ballRadius;
  if (s.goalDepth > diameter && s.goalWidth > diameter) return;
  throw config::ParameterError(fmt::format(
      "the ball does not fit into the goals: GoalDepth = {} m and GoalWidth = {} m must be more than "
      "twice BallRadius = {} m; make the goals larger or the ball smaller",
      s.goalDepth, s.goalWidth, s.ballRadius));
}

// A guess only if it is near: a far one misleads.
void checkKnown(const Settings& settings, std::string_view name) {
  std::vector<std::string> names;
  for (const config::ParameterView& view : listSettings(settings)) names.push_back(view.key);
  if (std::find(names.begin(), names.end(), name) != names.end()) return;
  const std::string nearest = config::nearestOf(names, name);
  const bool near = 2 * config::editDistance(nearest, name) <= name.size();
  throw config::ParameterError(fmt::format("unknown setting '{}': {}nonet serve --list-settings shows all",
                                           name, near ? fmt::format("did you mean '{}'? ", nearest) : ""));
}

}  // namespace

void Settings::senseTruth() {
  senseMyPos = true;
  senseMyOrien = true;
  senseBallPos = true;
}

void Settings::removeNoise() {
  visionNoise = false;
  beamNoiseXY = 0.0;
  beamNoiseAngle = 0.0;
}

void Settings::setField(std::string_view preset) {
  if (preset == "30x20") {
    fieldLength = 30.0;
    fieldWidth = 20.0;
    freeKickDistance = 2.0;
    freeKickMoveDist = 2.5;
  } else if (preset == "21x14") {
    fieldLength = 21.0;
    fieldWidth = 14.0;
    freeKickDistance = 1.8;
    freeKickMoveDist = 2.3;
  } else {
    throw config::ParameterError(fmt::format("unknown field '{}': known are 30x20 and 21x14", preset));
  }
}

void Settings::set(std::string_view name, std::string_view value) {
  checkKnown(*this, name);
  config::setParameterText(*this, name, value);
}

void Settings::setAssignment(std::string_view assignment) {
  const auto equals = assignment.find('=');
  if (equals == std::string_view::npos) {
    throw config::ParameterError(fmt::format("'{}' is not of the form Name=Value", assignment));
  }
  set(config::trimmed(assignment.substr(0, equals)), config::trimmed(assignment.substr(equals + 1)));
}

void Settings::overlayFile(const std::string& path) {
  SettingsFile file{*this};
  config::overlayFile(file, path);
  *this = file.settings;
}

void Settings::overlayText(std::string_view toml, const std::string& nameForErrors) {
  SettingsFile file{*this};
  config::overlayText(file, toml, nameForErrors);
  *this = file.settings;
}

WorldSettings Settings::world() const {
  checkGoals(*this);
  WorldSettings world;
  world.solver = quickSolver ? WorldSettings::Solver::Quick : WorldSettings::Solver::Exact;
  world.threads = threads;
  world.threadPatience = std::chrono::microseconds(threadPatience);
  world.fieldLength = fieldLength;
  world.fieldWidth = fieldWidth;
  world.goalWidth = goalWidth;
  world.goalDepth = goalDepth;
  world.goalHeight = goalHeight;
  world.ballRadius = ballRadius;
  world.ballMass = ballMass;
  return world;
}

std::vector<config::ParameterView> listSettings(const Settings& settings) {
  return config::listParameters(settings);
}

}  // namespace nonet::sim
