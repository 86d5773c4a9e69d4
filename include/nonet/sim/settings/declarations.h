// The settings as declared parameters: the names of the server's script, units, ranges and a sentence each.
#pragma once

#include "nonet/config/parameters.h"
#include "nonet/sim/settings/settings.h"

namespace nonet::sim {

namespace declarations {

using config::fixed;
using config::Range;
using config::Unit;

inline constexpr Range kLength{0.0, 1000.0};
inline constexpr Range kAngle{0.0, 360.0};
inline constexpr Range kSpeed{0.0, 1000.0};
inline constexpr Range kTime{0.0, 1e6};
inline constexpr Range kCount{0.0, 1000.0};

/// The kinds of settings that there are most of.
template <class Visitor>
struct Shorthand {
  Visitor& visit;

  void length(std::string_view name, double& field, std::string_view text) const {
    visit({name, Unit::Metre, kLength, fixed, text}, field);
  }
  void time(std::string_view name, double& field, std::string_view text) const {
    visit({name, Unit::Second, kTime, fixed, text}, field);
  }
  void toggle(std::string_view name, bool& field, std::string_view text) const {
    visit({name, Unit::None, {}, fixed, text}, field);
  }
};
template <class Visitor>
Shorthand(Visitor&) -> Shorthand<Visitor>;  // clang 14 does not find it by itself

template <class Self, class Visitor>
void describeField(Self& s, Visitor&& visit) {
  const Range position{-1000.0, 1000.0};
  const Shorthand a{visit};
  visit({"FieldLength", Unit::Metre, {1.0, 1000.0}, fixed, "Length of the field"}, s.fieldLength);
  visit({"FieldWidth", Unit::Metre, {1.0, 1000.0}, fixed, "Width of the field"}, s.fieldWidth);
  a.length("FieldHeight", s.fieldHeight, "Height of the field, only for monitors");
  a.length("GoalWidth", s.goalWidth, "Inner width of the goals");
  a.length("GoalDepth", s.goalDepth, "Depth of the goals");
  a.length("GoalHeight", s.goalHeight, "Inner height of the goals");
  a.length("PenaltyLength", s.penaltyLength, "Depth of the penalty areas");
  a.length("PenaltyWidth", s.penaltyWidth, "Width of the penalty areas beyond that of the goal");
  a.length("BorderSize", s.borderSize, "Width of the border around the field, only for monitors");
  visit({"BallRadius", Unit::Metre, {0.001, 1.0}, fixed, "Radius of the ball"}, s.ballRadius);
  visit({"BallMass", Unit::Kilogram, {0.0001, 100.0}, fixed, "Mass of the ball"}, s.ballMass);
  visit({"AgentRadius",
         Unit::Metre,
         {0.1, kLength.high},
         fixed,
         "Free space around the places to which the referee moves robots"},
        s.agentRadius);
  visit({"Keepaway", Unit::None, {}, fixed, "Keepaway instead of football"}, s.keepaway);
  visit({"KeepawayCenterX", Unit::Metre, position, fixed, "Centre of the keepaway area, along the field"},
        s.keepawayCenterX);
  visit({"KeepawayCenterY", Unit::Metre, position, fixed, "Centre of the keepaway area, across the field"},
        s.keepawayCenterY);
  a.length("KeepawayLength", s.keepawayLength, "Length of the keepaway area at the start");
  a.length("KeepawayWidth", s.keepawayWidth, "Width of the keepaway area at the start");
  visit({"KeepawayLengthReductionRate", Unit::None, kLength, fixed,
         "How fast the keepaway area gets shorter, in metres per minute"},
        s.keepawayLengthReductionRate);
  visit({"KeepawayWidthReductionRate", Unit::None, kLength, fixed,
         "How fast the keepaway area gets narrower, in metres per minute"},
        s.keepawayWidthReductionRate);
}

template <class Self, class Visitor>
void describeMatch(Self& s, Visitor&& visit) {
  const Shorthand a{visit};
  a.length("FreeKickDistance", s.freeKickDistance,
           "Distance that opponents keep at set pieces; radius of the centre circle");
  a.length("FreeKickMoveDist", s.freeKickMoveDist,
           "Distance to which the referee moves those who are nearer");
  a.length("KickRepelDist", s.kickRepelDist, "Distance to which the kicking team is pushed once");
  a.length("GoalKickDist", s.goalKickDist, "Distance of a goal kick from the goal line");
  a.time("RuleGoalPauseTime", s.ruleGoalPauseTime, "Pause after a goal");
  a.time("RuleKickInPauseTime", s.ruleKickInPauseTime, "Pause before a set piece");
  a.time("RuleHalfTime", s.ruleHalfTime, "Length of a half");
  a.time("RuleDropBallTime", s.ruleDropBallTime, "Time after which a set piece that nobody took is dropped");
  a.toggle("AutomaticKickOff", s.automaticKickOff, "Kick off without a human referee");
  a.time("WaitBeforeKickOff", s.waitBeforeKickOff, "Time before the automatic kick-off");
  a.toggle("CoinTossForKickOff", s.coinTossForKickOff, "Toss for the first kick-off, or else left has it");
  a.toggle("PenaltyShootout", s.penaltyShootout, "Penalty shoot-out: the right goalkeeper stays in its area");
  a.toggle("StartAnyFieldPosition", s.startAnyFieldPosition,
           "Before kick-off robots may beam to any place and are not moved");
  a.toggle("AutomaticQuit", s.automaticQuit, "Without effect, as in the server");
  a.toggle("ChangeSidesInSecondHalf", s.changeSidesInSecondHalf, "Teams change sides at half time");
  a.toggle("SingleHalfTime", s.singleHalfTime, "The match ends after one half");
  a.toggle("UseOffside", s.useOffside, "Without effect, as in the server");
  visit({"MaxRobotTypeCount", Unit::None, kCount, fixed, "Greatest number of robots of one type in a team"},
        s.maxRobotTypeCount);
  visit({"MinRobotTypesCount", Unit::None, kCount, fixed, "Least number of different types in a full team"},
        s.minRobotTypesCount);
  visit({"MaxSumTwoRobotTypes", Unit::None, kCount, fixed, "Greatest number of robots of two types together"},
        s.maxSumTwoRobotTypes);
  visit({"PassModeMaxBallSpeed", Unit::MetrePerSecond, kSpeed, fixed,
         "Greatest speed of the ball at which pass mode is granted"},
        s.passModeMaxBallSpeed);
  a.length("PassModeMaxBallDist", s.passModeMaxBallDist,
           "Greatest distance of who asks for pass mode from the ball");
  a.length("PassModeMinOppBallDist", s.passModeMinOppBallDist, "Distance that opponents keep in pass mode");
  a.time("PassModeDuration", s.passModeDuration, "Length of pass mode");
  a.time("PassModeScoreWaitTime", s.passModeScoreWaitTime,
         "Time after pass mode in which a goal needs a second touch");
  a.time("PassModeRetryWaitTime", s.passModeRetryWaitTime, "Time before a team may have pass mode again");
}

template <class Self, class Visitor>
void describeCharging(Self& s, Visitor&& visit) {
  visit({"UseCharging", Unit::None, {}, fixed, "Charging is a foul"}, s.useCharging);
  visit({"ChargingMinSpeed", Unit::MetrePerSecond, kSpeed, fixed, "Least speed of who charges"},
        s.chargingMinSpeed);
  visit({"ChargingMinBallSpeedAngle", Unit::Degree, kAngle, fixed,
         "Least angle between the way of who charges and the direction to the ball"},
        s.chargingMinBallSpeedAngle);
  visit({"ChargingMinDeltaDist", Unit::Metre, kLength, fixed,
         "Least difference of the distances to the ball by which one of two charges"},
        s.chargingMinDeltaDist);
  visit({"ChargingMinDeltaAng", Unit::Degree, kAngle, fixed,
         "Least difference of the angles to each other by which one of two charges"},
        s.chargingMinDeltaAng);
  visit({"ChargingImmunityTime", Unit::Second, kTime, fixed,
         "Time after touching the ball in which nobody charges"},
        s.chargingImmunityTime);
  visit({"ChargingCollisionMinTime", Unit::Second, kTime, fixed,
         "Least time since the last contact that was nobody's charging"},
        s.chargingCollisionMinTime);
  visit({"ChargingMaxBallRulesDist", Unit::Metre, kLength, fixed,
         "Distance from the ball within which the way to the ball counts"},
        s.chargingMaxBallRulesDist);
  visit({"ChargingMinCollBallDist", Unit::Metre, kLength, fixed,
         "Contacts nearer to the ball than this are nobody's charging"},
        s.chargingMinCollBallDist);
  visit({"ChargingMinCollisionSpeed", Unit::MetrePerSecond, kSpeed, fixed,
         "Least speed of who charges towards the opponent"},
        s.chargingMinCollisionSpeed);
}

template <class Self, class Visitor>
void describeFouls(Self& s, Visitor&& visit) {
  const Shorthand a{visit};
  visit({"MaxTouchGroupSize", Unit::None, kCount, fixed,
         "Greatest number of robots that may touch one another"},
        s.maxTouchGroupSize);
  a.toggle("TouchingFoulBeamPenalty", s.touchingFoulBeamPenalty,
           "Touching is punished by removal from the field");
  a.length("SelfCollisionsTolerance", s.selfCollisionsTolerance,
           "Overlap of a robot's parts that is no self-collision");
  a.toggle("PrintSelfCollisions", s.printSelfCollisions, "Write self-collisions to the log");
  a.toggle("FoulOnSelfCollisions", s.foulOnSelfCollisions, "Self-collisions are a foul");
  a.time("SelfCollisionJointFrozenTime", s.selfCollisionJointFrozenTime,
         "Time for which the joints of a self-collision are frozen");
  a.time("SelfCollisionJointThawTime", s.selfCollisionJointThawTime,
         "Time after that in which they cannot be frozen anew");
  a.toggle("SelfCollisionBeamPenalty", s.selfCollisionBeamPenalty,
           "Self-collisions are punished by removal from the field, no joints are frozen");
  a.time("SelfCollisionBeamCooldownTime", s.selfCollisionBeamCooldownTime,
         "Least time between two removals of a robot for self-collisions");
  a.toggle("WriteSelfCollisionsToFile", s.writeSelfCollisionsToFile, "Append self-collisions to a file");
  visit(
      {"SelfCollisionRecordFilename", Unit::None, {}, fixed, "The file that self-collisions are appended to"},
      s.selfCollisionRecordFilename);
  a.time("NotStandingMaxTime", s.notStandingMaxTime,
         "Time after which a player who does not stand is removed");
  a.time("GoalieNotStandingMaxTime", s.goalieNotStandingMaxTime,
         "Time after which a goalkeeper that does not stand is removed");
  a.time("GroundMaxTime", s.groundMaxTime, "Time after which a player who lies is removed");
  a.time("GoalieGroundMaxTime", s.goalieGroundMaxTime, "Time after which a goalkeeper that lies is removed");
  visit({"MaxPlayersInsideOwnArea", Unit::None, kCount, fixed,
         "Greatest number of players inside their own penalty area"},
        s.maxPlayersInsideOwnArea);
  a.toggle("IllegalDefenseBeamPenalty", s.illegalDefenseBeamPenalty,
           "Illegal defence is punished by removal from the field");
  a.length("MinOppDistance", s.minOppDistance,
           "Crowding counts while an opponent is nearer to the ball than this");
  a.length("Min2PlDistance", s.min2PlDistance,
           "Crowding: distance from the ball that the second of a team keeps");
  a.length("Min3PlDistance", s.min3PlDistance,
           "Crowding: distance from the ball that the third of a team keeps");
  a.time("FoulHoldTime", s.foulHoldTime, "Time for which a removed robot is held in the air");
  visit({"MaxNumSafeRepositionAttempts",
         Unit::None,
         {0.0, 1e6},
         fixed,
         "Greatest number of places that are tried when the referee moves a robot"},
        s.maxNumSafeRepositionAttempts);
}

template <class Self, class Visitor>
void describeSenses(Self& s, Visitor&& visit) {
  const Shorthand a{visit};
  a.toggle("ReportScore", s.reportScore, "Tell agents the score");
  a.toggle("LabelMessages", s.labelMessages, "Tell agents the team of what they hear");
  visit({"BeamNoiseXY", Unit::Metre, kLength, fixed, "Greatest error of a beam along each axis"},
        s.beamNoiseXY);
  visit({"BeamNoiseAngle", Unit::Degree, kAngle, fixed, "Greatest error of a beam's direction"},
        s.beamNoiseAngle);
  a.toggle("VisionNoise", s.visionNoise, "Vision has noise and a calibration error");
  a.toggle("SenseMyPos", s.senseMyPos, "Tell agents their true position, as (mypos x y z) in See");
  a.toggle("SenseMyOrien", s.senseMyOrien, "Tell agents their true heading, as (myorien a) in See");
  a.toggle("SenseBallPos", s.senseBallPos,
           "Tell agents the true position of the ball, as (ballpos x y z) in See");
}

template <class Self, class Visitor>
void describeProcess(Self& s, Visitor&& visit) {
  visit(
      {"SayLossShare",
       Unit::None,
       {0.0, 1.0},
       fixed,
       "Share of the messages that a listener misses beside what the rules of hearing cost, by chance, each "
       "listener for itself"},
      s.sayLossShare);
  visit({"LeftTeam", Unit::None, {}, fixed, "Name of the team that plays left; empty: the first that comes"},
        s.leftTeam);
  visit(
      {"RightTeam", Unit::None, {}, fixed, "Name of the team that plays right; empty: the second that comes"},
      s.rightTeam);
  visit({"QuickSolver", Unit::None, {}, fixed, "The quick stepper instead of ODE's exact one"},
        s.quickSolver);
  visit({"Threads",
         Unit::None,
         {1.0, 256.0},
         fixed,
         "Threads that step the physics, without effect on the result"},
        s.threads);
  visit({"ThreadPatience",
         Unit::None,
         {0.0, 1e6},
         fixed,
         "Microseconds for which such a thread looks out for work before it sleeps; 0 leaves the cores to "
         "others"},
        s.threadPatience);
}

}  // namespace declarations

template <class Self, class Visitor>
void Settings::describe(Self& self, Visitor&& visit) {
  declarations::describeField(self, visit);
  declarations::describeMatch(self, visit);
  declarations::describeCharging(self, visit);
  declarations::describeFouls(self, visit);
  declarations::describeSenses(self, visit);
  declarations::describeProcess(self, visit);
}

}  // namespace nonet::sim
