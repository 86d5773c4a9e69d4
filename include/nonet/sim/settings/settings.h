// Everything about a simulation that can be chosen: the Soccer variables of the server's script under their
// own names and with their own defaults (server facts 4.1), and what other tools switch by editing the script
// (noise, ground truth, solver). A process (ports, pace, lock-step) is chosen in ServerSettings.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "nonet/config/parameters.h"
#include "nonet/model/ball.h"
#include "nonet/sim/physics/world.h"

namespace nonet::sim {

struct Settings {
  // -- field and ball: metres, kilograms
  double fieldLength = 30.0;
  double fieldWidth = 20.0;
  double fieldHeight = 40.0;
  double goalWidth = 2.1;
  double goalDepth = 0.6;
  double goalHeight = 0.8;
  double penaltyLength = 1.8;
  double penaltyWidth = 3.9;  // without the width of the goal: the area is penaltyWidth + goalWidth wide
  double borderSize = 0.0;
  double ballRadius = model::kBallRadius;
  double ballMass = 0.026;
  double agentRadius = 0.4;

  // -- set pieces: metres, seconds
  double freeKickDistance = 2.0;  // also the radius of the centre circle
  double freeKickMoveDist = 2.5;
  double kickRepelDist = 0.5;
  double goalKickDist = 1.0;
  double ruleGoalPauseTime = 3.0;
  double ruleKickInPauseTime = 1.0;
  double ruleHalfTime = 300.0;
  double ruleDropBallTime = 15.0;

  // -- the course of a match
  bool automaticKickOff = false;
  double waitBeforeKickOff = 30.0;  // s
  bool coinTossForKickOff = false;
  bool penaltyShootout = false;
  bool startAnyFieldPosition = false;
  bool automaticQuit = false;
  bool changeSidesInSecondHalf = false;
  bool singleHalfTime = false;
  bool useOffside = false;
  bool keepaway = false;
  double keepawayCenterX = 0.0;
  double keepawayCenterY = 0.0;
  double keepawayLength = 20.0;
  double keepawayWidth = 20.0;
  double keepawayLengthReductionRate = 4.0;  // m per minute
  double keepawayWidthReductionRate = 4.0;

  // -- robot types in a team (server facts 1.4)
  int maxRobotTypeCount = 7;
  int minRobotTypesCount = 3;
  int maxSumTwoRobotTypes = 9;

  // -- fouls (server facts 4.10): seconds, metres, degrees
  int maxTouchGroupSize = 2;
  bool touchingFoulBeamPenalty = false;
  bool useCharging = true;
  double chargingMinSpeed = 0.4;
  double chargingMinBallSpeedAngle = 30.0;
  double chargingMinDeltaDist = 0.05;
  double chargingMinDeltaAng = 15.0;
  double chargingImmunityTime = 1.0;
  double chargingCollisionMinTime = 0.2;
  double chargingMaxBallRulesDist = 1.0;
  double chargingMinCollBallDist = 0.1;
  double chargingMinCollisionSpeed = 0.2;
  double selfCollisionsTolerance = 0.04;
  bool printSelfCollisions = true;
  bool foulOnSelfCollisions = true;
  double selfCollisionJointFrozenTime = 1.0;
  double selfCollisionJointThawTime = 2.0;
  bool selfCollisionBeamPenalty = false;
  double selfCollisionBeamCooldownTime = 10.0;
  bool writeSelfCollisionsToFile = false;
  std::string selfCollisionRecordFilename = "SelfCollisions.txt";
  double notStandingMaxTime = 30.0;
  double goalieNotStandingMaxTime = 60.0;
  double groundMaxTime = 15.0;
  double goalieGroundMaxTime = 30.0;
  int maxPlayersInsideOwnArea = 3;
  bool illegalDefenseBeamPenalty = false;
  double minOppDistance = 0.0;  // crowding is off while these three are 0
  double min2PlDistance = 0.0;
  double min3PlDistance = 0.0;
  double foulHoldTime = 0.5;
  int maxNumSafeRepositionAttempts = 100;

  // -- pass mode (server facts 4.9)
  double passModeMaxBallSpeed = 0.05;  // m/s
  double passModeMaxBallDist = 0.5;
  double passModeMinOppBallDist = 1.0;
  double passModeDuration = 4.0;
  double passModeScoreWaitTime = 10.0;
  double passModeRetryWaitTime = 3.0;

  // -- what agents are told, and noise
  bool reportScore = true;
  bool labelMessages = true;
  double beamNoiseXY = 0.05;     // m
  double beamNoiseAngle = 10.0;  // degrees
  bool visionNoise = true;       // false: neither the noise of each sighting nor the calibration error
  bool senseMyPos = false;       // (mypos x y z) in See
  bool senseMyOrien = false;     // (myorien a)
  bool senseBallPos = false;     // (ballpos x y z)

  // -- not in the server: how reproducible matches and fast training are had
  double sayLossShare = 0.0;  // of all messages, for each listener by itself
  std::string leftTeam;       // fixes which name plays left; empty: the first name that is used
  std::string rightTeam;      // likewise right
  bool quickSolver = false;
  int threads = 1;
  int threadPatience = 0;  // microseconds for which a thread looks out for work before it sleeps

  /// Switches mypos, myorien and ballpos on.
  void senseTruth();
  /// Switches the noise of vision, calibration and beam off.
  void removeNoise();
  /// "30x20" (the default) or "21x14" (the field of 2012 and 2013). Throws config::ParameterError for
  /// anything else.
  void setField(std::string_view preset);

  // All of these throw config::ParameterError for an unknown name (with the nearest known one), a wrong type,
  // unit or range, and then change nothing.
  /// Sets one value by its server name ("RuleHalfTime"), as people type it: "60", "60s", "true".
  void set(std::string_view name, std::string_view value);
  /// "Name=Value".
  void setAssignment(std::string_view assignment);
  /// Overlays a TOML file of `Name = value` lines, which may stand in a [Soccer] table. Errors name file and
  /// line.
  void overlayFile(const std::string& path);
  void overlayText(std::string_view toml, const std::string& nameForErrors);

  /// Declares all settings as parameters: see declarations.h.
  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit);

  /// Throws config::ParameterError if the ball does not fit into the goals.
  WorldSettings world() const;
};

/// All settings with their present values, in the order of declaration.
std::vector<config::ParameterView> listSettings(const Settings& settings);

}  // namespace nonet::sim
