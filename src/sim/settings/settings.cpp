#include "nonet/sim/settings/settings.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <concepts>
#include <fstream>
#include <sstream>

#include <fmt/format.h>
#include <toml++/toml.h>

namespace nonet::sim {

namespace {

struct Bounds {
  double low = 0.0;
  double high = 1e6;
};

// Every setting once: its name in the server's script, the field, the values that make sense, a sentence.
template <class Self, class Visitor>
void describe(Self& s, Visitor&& visit) {
  const Bounds length{0.0, 1000.0};
  const Bounds time{0.0, 1e6};
  const Bounds count{0, 1000};
  visit("FieldLength", s.fieldLength, Bounds{1.0, 1000.0}, "length of the field, m");
  visit("FieldWidth", s.fieldWidth, Bounds{1.0, 1000.0}, "width of the field, m");
  visit("FieldHeight", s.fieldHeight, length, "height reported to monitors, m");
  visit("GoalWidth", s.goalWidth, length, "inner width of the goals, m");
  visit("GoalDepth", s.goalDepth, length, "depth of the goals, m");
  visit("GoalHeight", s.goalHeight, length, "inner height of the goals, m");
  visit("PenaltyLength", s.penaltyLength, length, "depth of the penalty areas, m");
  visit("PenaltyWidth", s.penaltyWidth, length, "width of the penalty areas beyond that of the goal, m");
  visit("BorderSize", s.borderSize, length, "reported to monitors, m");
  visit("BallRadius", s.ballRadius, Bounds{0.001, 1.0}, "m");
  visit("BallMass", s.ballMass, Bounds{0.0001, 100.0}, "kg");
  visit("AgentRadius", s.agentRadius, length, "margin around robots that the referee places, m");
  visit("FreeKickDistance", s.freeKickDistance, length,
        "opponents' distance at set pieces, circle radius, m");
  visit("FreeKickMoveDist", s.freeKickMoveDist, length, "distance to which the referee moves players, m");
  visit("KickRepelDist", s.kickRepelDist, length, "distance to which the kicking team is pushed once, m");
  visit("GoalKickDist", s.goalKickDist, length, "distance of a goal kick from the goal line, m");
  visit("RuleGoalPauseTime", s.ruleGoalPauseTime, time, "pause after a goal, s");
  visit("RuleKickInPauseTime", s.ruleKickInPauseTime, time, "pause before a set piece, s");
  visit("RuleHalfTime", s.ruleHalfTime, time, "length of a half, s");
  visit("RuleDropBallTime", s.ruleDropBallTime, time, "time after which an unused set piece is dropped, s");
  visit("AutomaticKickOff", s.automaticKickOff, count, "kick off without a human referee");
  visit("WaitBeforeKickOff", s.waitBeforeKickOff, time, "time before the automatic kick-off, s");
  visit("CoinTossForKickOff", s.coinTossForKickOff, count, "toss for the first kick-off (else left)");
  visit("PenaltyShootout", s.penaltyShootout, count, "the right goalie must stay in its area");
  visit("StartAnyFieldPosition", s.startAnyFieldPosition, count,
        "beam anywhere, no clearing before kick-off");
  visit("AutomaticQuit", s.automaticQuit, count, "has no effect, as in the server");
  visit("ChangeSidesInSecondHalf", s.changeSidesInSecondHalf, count, "teams change sides at half time");
  visit("SingleHalfTime", s.singleHalfTime, count, "the match ends after one half");
  visit("UseOffside", s.useOffside, count, "has no effect, as in the server");
  visit("Keepaway", s.keepaway, count, "keepaway instead of football");
  visit("KeepawayCenterX", s.keepawayCenterX, Bounds{-1000, 1000}, "m");
  visit("KeepawayCenterY", s.keepawayCenterY, Bounds{-1000, 1000}, "m");
  visit("KeepawayLength", s.keepawayLength, length, "m");
  visit("KeepawayWidth", s.keepawayWidth, length, "m");
  visit("KeepawayLengthReductionRate", s.keepawayLengthReductionRate, length, "m per minute");
  visit("KeepawayWidthReductionRate", s.keepawayWidthReductionRate, length, "m per minute");
  visit("MaxRobotTypeCount", s.maxRobotTypeCount, count, "robots of one type in a team");
  visit("MinRobotTypesCount", s.minRobotTypesCount, count, "different types in a full team");
  visit("MaxSumTwoRobotTypes", s.maxSumTwoRobotTypes, count, "robots of any two types together");
  visit("MaxTouchGroupSize", s.maxTouchGroupSize, count, "robots that may touch one another");
  visit("TouchingFoulBeamPenalty", s.touchingFoulBeamPenalty, count, "touching is punished by removal");
  visit("UseCharging", s.useCharging, count, "charging is a foul");
  visit("ChargingMinSpeed", s.chargingMinSpeed, length, "m/s");
  visit("ChargingMinBallSpeedAngle", s.chargingMinBallSpeedAngle, Bounds{0, 360}, "degrees");
  visit("ChargingMinDeltaDist", s.chargingMinDeltaDist, length, "m");
  visit("ChargingMinDeltaAng", s.chargingMinDeltaAng, Bounds{0, 360}, "degrees");
  visit("ChargingImmunityTime", s.chargingImmunityTime, time, "s after touching the ball");
  visit("ChargingCollisionMinTime", s.chargingCollisionMinTime, time, "s");
  visit("ChargingMaxBallRulesDist", s.chargingMaxBallRulesDist, length, "m");
  visit("ChargingMinCollBallDist", s.chargingMinCollBallDist, length, "m");
  visit("ChargingMinCollisionSpeed", s.chargingMinCollisionSpeed, length, "m/s");
  visit("SelfCollisionsTolerance", s.selfCollisionsTolerance, length, "overlap that is no collision, m");
  visit("PrintSelfCollisions", s.printSelfCollisions, count, "log self-collisions");
  visit("FoulOnSelfCollisions", s.foulOnSelfCollisions, count, "self-collisions freeze joints");
  visit("SelfCollisionJointFrozenTime", s.selfCollisionJointFrozenTime, time, "s");
  visit("SelfCollisionJointThawTime", s.selfCollisionJointThawTime, time, "s");
  visit("SelfCollisionBeamPenalty", s.selfCollisionBeamPenalty, count, "punished by removal instead");
  visit("SelfCollisionBeamCooldownTime", s.selfCollisionBeamCooldownTime, time, "s");
  visit("WriteSelfCollisionsToFile", s.writeSelfCollisionsToFile, count, "append self-collisions to a file");
  visit("SelfCollisionRecordFilename", s.selfCollisionRecordFilename, count, "that file");
  visit("NotStandingMaxTime", s.notStandingMaxTime, time, "s");
  visit("GoalieNotStandingMaxTime", s.goalieNotStandingMaxTime, time, "s");
  visit("GroundMaxTime", s.groundMaxTime, time, "s");
  visit("GoalieGroundMaxTime", s.goalieGroundMaxTime, time, "s");
  visit("MaxPlayersInsideOwnArea", s.maxPlayersInsideOwnArea, count, "more are an illegal defence");
  visit("IllegalDefenseBeamPenalty", s.illegalDefenseBeamPenalty, count, "punished by removal");
  visit("MinOppDistance", s.minOppDistance, length, "crowding: nearest opponent to the ball, m");
  visit("Min2PlDistance", s.min2PlDistance, length, "crowding: second player, m");
  visit("Min3PlDistance", s.min3PlDistance, length, "crowding: third player, m");
  visit("FoulHoldTime", s.foulHoldTime, time, "time a punished robot is held in the air, s");
  visit("MaxNumSafeRepositionAttempts", s.maxNumSafeRepositionAttempts, Bounds{0, 1e6},
        "places that are tried when a robot is moved");
  visit("PassModeMaxBallSpeed", s.passModeMaxBallSpeed, length, "m/s");
  visit("PassModeMaxBallDist", s.passModeMaxBallDist, length, "m");
  visit("PassModeMinOppBallDist", s.passModeMinOppBallDist, length, "m");
  visit("PassModeDuration", s.passModeDuration, time, "s");
  visit("PassModeScoreWaitTime", s.passModeScoreWaitTime, time, "s");
  visit("PassModeRetryWaitTime", s.passModeRetryWaitTime, time, "s");
  visit("ReportScore", s.reportScore, count, "(sl N) (sr N) in GS");
  visit("LabelMessages", s.labelMessages, count, "team names in hear");
  visit("BeamNoiseXY", s.beamNoiseXY, length, "greatest error of a beam, m");
  visit("BeamNoiseAngle", s.beamNoiseAngle, Bounds{0, 360}, "greatest error of a beam, degrees");
  visit("VisionNoise", s.visionNoise, count, "noise and calibration error of vision");
  visit("SenseMyPos", s.senseMyPos, count, "(mypos x y z) in See");
  visit("SenseMyOrien", s.senseMyOrien, count, "(myorien a) in See");
  visit("SenseBallPos", s.senseBallPos, count, "(ballpos x y z) in See");
  visit("LeftTeam", s.leftTeam, count, "name of the team that plays left");
  visit("RightTeam", s.rightTeam, count, "name of the team that plays right");
  visit("QuickSolver", s.quickSolver, count, "the quick stepper instead of ODE's exact one");

  visit("Threads", s.threads, Bounds{1, 256}, "threads that step the physics; without effect on the result");
  visit("ThreadPatience", s.threadPatience, Bounds{0, 1e6},
        "us for which one of them looks out for work before it sleeps; 0 leaves the cores to the agents");
}

double toNumber(std::string_view name, std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) {
    throw SettingsError(fmt::format("setting {}: '{}' is not a number", name, text));
  }
  return value;
}

void checkBounds(std::string_view name, double value, const Bounds& bounds) {
  if (value < bounds.low || value > bounds.high) {
    throw SettingsError(
        fmt::format("setting {}: {} is outside {} .. {}", name, value, bounds.low, bounds.high));
  }
}

void assign(std::string_view name, std::string_view text, const Bounds& bounds, double& field) {
  const double value = toNumber(name, text);
  checkBounds(name, value, bounds);
  field = value;
}

void assign(std::string_view name, std::string_view text, const Bounds& bounds, int& field) {
  const double value = toNumber(name, text);
  checkBounds(name, value, bounds);
  if (value != std::floor(value)) {
    throw SettingsError(fmt::format("setting {}: '{}' is not a whole number", name, text));
  }
  field = static_cast<int>(value);
}

void assign(std::string_view name, std::string_view text, const Bounds&, bool& field) {
  if (text == "true" || text == "1" || text == "on") {
    field = true;
  } else if (text == "false" || text == "0" || text == "off") {
    field = false;
  } else {
    throw SettingsError(fmt::format("setting {}: '{}' is neither true nor false", name, text));
  }
}

void assign(std::string_view, std::string_view text, const Bounds&, std::string& field) {
  field = text;
}

// Levenshtein's distance, case ignored: for "did you mean".
std::size_t editDistance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = std::tolower(static_cast<unsigned char>(a[i - 1])) ==
                        std::tolower(static_cast<unsigned char>(b[j - 1]));
      const std::size_t replaced = diagonal + (same ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
    }
  }
  return row[b.size()];
}

std::string trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return std::string(text.substr(first, text.find_last_not_of(" \t") - first + 1));
}

void overlayTable(Settings& settings, const toml::table& table, const std::string& file) {
  for (const auto& [key, node] : table) {
    const auto line = node.source().begin.line;
    if (const auto* nested = node.as_table()) {
      if (key != "Soccer") {
        throw SettingsError(fmt::format("{}:{}: unknown table [{}] (only [Soccer] is allowed)", file, line,
                                        std::string_view(key.str())));
      }
      overlayTable(settings, *nested, file);
      continue;
    }
    std::string value;
    if (const auto number = node.value_exact<double>()) {
      value = fmt::format("{}", *number);
    } else if (const auto integer = node.value_exact<std::int64_t>()) {
      value = fmt::format("{}", *integer);
    } else if (const auto truth = node.value_exact<bool>()) {
      value = *truth ? "true" : "false";
    } else if (const auto text = node.value_exact<std::string>()) {
      value = *text;
    } else {
      throw SettingsError(fmt::format("{}:{}: {} needs a number, true, false or a text", file, line,
                                      std::string_view(key.str())));
    }
    try {
      settings.set(key.str(), value);
    } catch (const SettingsError& error) {
      throw SettingsError(fmt::format("{}:{}: {}", file, line, error.what()));
    }
  }
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
    throw SettingsError(fmt::format("unknown field '{}': known are 30x20 and 21x14", preset));
  }
}

void Settings::set(std::string_view name, std::string_view value) {
  bool found = false;
  std::string nearest;
  std::size_t nearestDistance = std::string::npos;
  describe(*this, [&](std::string_view known, auto& field, const Bounds& bounds, std::string_view) {
    if (known == name) {
      assign(name, value, bounds, field);
      found = true;
    }
    if (found) return;
    const std::size_t distance = editDistance(name, known);
    if (distance < nearestDistance) {
      nearestDistance = distance;
      nearest = known;
    }
  });
  if (!found) {
    throw SettingsError(fmt::format("unknown setting '{}': did you mean {}?", name, nearest));
  }
}

void Settings::setAssignment(std::string_view assignment) {
  const auto equals = assignment.find('=');
  if (equals == std::string_view::npos) {
    throw SettingsError(fmt::format("'{}' is not of the form Name=Value", assignment));
  }
  set(trimmed(assignment.substr(0, equals)), trimmed(assignment.substr(equals + 1)));
}

void Settings::overlayFile(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw SettingsError(fmt::format("cannot read settings file {}", path));
  std::ostringstream text;
  text << file.rdbuf();
  overlayText(text.str(), path);
}

void Settings::overlayText(std::string_view toml, const std::string& nameForErrors) {
  Settings copy = *this;
  try {
    overlayTable(copy, toml::parse(toml, nameForErrors), nameForErrors);
  } catch (const toml::parse_error& error) {
    throw SettingsError(
        fmt::format("{}:{}: {}", nameForErrors, error.source().begin.line, error.description()));
  }
  *this = copy;
}

WorldSettings Settings::world() const {
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

std::vector<SettingView> listSettings(const Settings& settings) {
  std::vector<SettingView> views;
  describe(settings, [&](std::string_view name, const auto& field, const Bounds&, std::string_view text) {
    views.push_back({std::string(name), fmt::format("{}", field), std::string(text)});
  });
  return views;
}

}  // namespace nonet::sim
