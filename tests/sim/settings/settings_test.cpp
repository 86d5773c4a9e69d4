#include "nonet/sim/settings/settings.h"

#include <functional>
#include <map>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "nonet/sim/settings/declarations.h"
#include "nonet/sim/simulation.h"

namespace nonet::sim {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::map<std::string, std::string> valuesOf(const Settings& settings) {
  std::map<std::string, std::string> values;
  for (const config::ParameterView& view : listSettings(settings)) values[view.key] = view.text;
  return values;
}

std::string messageOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const config::ParameterError& error) {
    return error.what();
  }
  return "no error";
}

// Server facts 4.1, copied from there.
TEST(Settings, EverySoccerVariableHasTheServersDefault) {
  const std::map<std::string, std::string> facts = {
      {"FieldLength", "30"},
      {"FieldWidth", "20"},
      {"FieldHeight", "40"},
      {"GoalWidth", "2.1"},
      {"GoalDepth", "0.6"},
      {"GoalHeight", "0.8"},
      {"PenaltyLength", "1.8"},
      {"PenaltyWidth", "3.9"},
      {"FreeKickDistance", "2"},
      {"FreeKickMoveDist", "2.5"},
      {"KickRepelDist", "0.5"},
      {"GoalKickDist", "1"},
      {"BorderSize", "0"},
      {"AutomaticKickOff", "false"},
      {"WaitBeforeKickOff", "30"},
      {"CoinTossForKickOff", "false"},
      {"PenaltyShootout", "false"},
      {"StartAnyFieldPosition", "false"},
      {"AutomaticQuit", "false"},
      {"ChangeSidesInSecondHalf", "false"},
      {"Keepaway", "false"},
      {"AgentRadius", "0.4"},
      {"MaxRobotTypeCount", "7"},
      {"MinRobotTypesCount", "3"},
      {"MaxSumTwoRobotTypes", "9"},
      {"BallRadius", "0.042"},
      {"BallMass", "0.026"},
      {"NotStandingMaxTime", "30"},
      {"GoalieNotStandingMaxTime", "60"},
      {"GroundMaxTime", "15"},
      {"GoalieGroundMaxTime", "30"},
      {"MaxPlayersInsideOwnArea", "3"},
      {"IllegalDefenseBeamPenalty", "false"},
      {"MinOppDistance", "0"},
      {"Min2PlDistance", "0"},
      {"Min3PlDistance", "0"},
      {"MaxNumSafeRepositionAttempts", "100"},
      {"PassModeMinOppBallDist", "1"},
      {"PassModeScoreWaitTime", "10"},
      {"RuleGoalPauseTime", "3"},
      {"RuleKickInPauseTime", "1"},
      {"RuleHalfTime", "300"},
      {"RuleDropBallTime", "15"},
      {"SingleHalfTime", "false"},
      {"UseOffside", "false"},
      {"MaxTouchGroupSize", "2"},
      {"TouchingFoulBeamPenalty", "false"},
      {"UseCharging", "true"},
      {"ChargingMinSpeed", "0.4"},
      {"ChargingMinBallSpeedAngle", "30"},
      {"ChargingMinDeltaDist", "0.05"},
      {"ChargingMinDeltaAng", "15"},
      {"ChargingImmunityTime", "1"},
      {"ChargingCollisionMinTime", "0.2"},
      {"ChargingMaxBallRulesDist", "1"},
      {"ChargingMinCollBallDist", "0.1"},
      {"ChargingMinCollisionSpeed", "0.2"},
      {"SelfCollisionsTolerance", "0.04"},
      {"PrintSelfCollisions", "true"},
      {"FoulOnSelfCollisions", "true"},
      {"SelfCollisionJointFrozenTime", "1"},
      {"SelfCollisionJointThawTime", "2"},
      {"SelfCollisionBeamPenalty", "false"},
      {"SelfCollisionBeamCooldownTime", "10"},
      {"WriteSelfCollisionsToFile", "false"},
      {"SelfCollisionRecordFilename", "SelfCollisions.txt"},
      {"FoulHoldTime", "0.5"},
      {"ReportScore", "true"},
      {"LabelMessages", "true"},
      {"BeamNoiseXY", "0.05"},
      {"BeamNoiseAngle", "10"},
      {"PassModeMaxBallSpeed", "0.05"},
      {"PassModeMaxBallDist", "0.5"},
      {"PassModeDuration", "4"},
      {"PassModeRetryWaitTime", "3"},
  };
  const auto values = valuesOf(Settings{});
  for (const auto& [name, value] : facts) {
    ASSERT_TRUE(values.contains(name)) << name;
    EXPECT_EQ(values.at(name), value) << name;
  }
}

TEST(Settings, SetByNameChangesExactlyThatSetting) {
  for (const config::ParameterView& view : listSettings(Settings{})) {
    Settings settings;
    const bool truth = view.kind == config::ParameterView::Kind::Boolean;
    const std::string other = truth ? (view.text == "true" ? "false" : "true") : view.text == "1" ? "2" : "1";
    settings.set(view.key, other);
    auto expected = valuesOf(Settings{});
    expected[view.key] = other;
    EXPECT_EQ(valuesOf(settings), expected) << view.key;
  }
}

TEST(Settings, DeclarationsAreSound) {
  EXPECT_THAT(config::declarationFaults(Settings{}), ::testing::IsEmpty());
}

TEST(Settings, ValuesMayHaveUnits) {
  Settings settings;
  settings.setAssignment("RuleHalfTime=1500ms");
  settings.setAssignment("FieldLength=2100cm");
  settings.setAssignment("BeamNoiseAngle=5deg");
  settings.overlayText("BallMass = \"30g\"\n", "a.toml");
  EXPECT_EQ(settings.ruleHalfTime, 1.5);
  EXPECT_EQ(settings.fieldLength, 21.0);
  EXPECT_EQ(settings.beamNoiseAngle, 5.0);
  EXPECT_EQ(settings.ballMass, 0.03);
}

TEST(Settings, WrittenAsTomlTheyReadBackTheSame) {
  Settings settings;
  settings.set("RuleHalfTime", "0.1");
  settings.set("LeftTeam", "a \"b\" \\ c\td");
  settings.set("UseCharging", "off");
  Settings again;
  again.overlayText(config::toToml(settings), "a.toml");
  EXPECT_EQ(valuesOf(again), valuesOf(settings));
  EXPECT_EQ(again.leftTeam, settings.leftTeam);
  EXPECT_THAT(
      config::toTomlDifference(settings, Settings{}),
      AllOf(HasSubstr("RuleHalfTime = 0.1"), HasSubstr("LeftTeam = "), HasSubstr("UseCharging = false")));
  EXPECT_EQ(config::toTomlDifference(settings, settings), "");
}

TEST(Settings, AssignmentOfTheCommandLine) {
  Settings settings;
  settings.setAssignment("RuleHalfTime=60");
  settings.setAssignment(" AutomaticKickOff = true ");
  EXPECT_EQ(settings.ruleHalfTime, 60.0);
  EXPECT_TRUE(settings.automaticKickOff);
  settings.setAssignment("FieldLength=+31");
  EXPECT_EQ(settings.fieldLength, 31.0);
  EXPECT_THAT(messageOf([&] { settings.setAssignment("RuleHalfTime"); }), HasSubstr("Name=Value"));
}

TEST(Settings, UnknownNameSuggestsTheNearest) {
  Settings settings;
  EXPECT_THAT(messageOf([&] { settings.set("RuleHalftime", "60"); }),
              AllOf(HasSubstr("'RuleHalftime'"), HasSubstr("did you mean 'RuleHalfTime'")));
  EXPECT_THAT(messageOf([&] { settings.set("BeamNoise", "0"); }), HasSubstr("did you mean 'BeamNoiseXY'"));
  EXPECT_EQ(messageOf([&] { settings.setAssignment("Foo=10"); }),
            "unknown setting 'Foo': nonet serve --list-settings shows all")
      << "no name is near";
}

TEST(Settings, WrongTypesAndRangesAreErrors) {
  Settings settings;
  EXPECT_THAT(messageOf([&] { settings.set("FieldLength", "long"); }), HasSubstr("not a number"));
  EXPECT_THAT(messageOf([&] { settings.set("FieldLength", "-3"); }), HasSubstr("out of range"));
  EXPECT_THAT(messageOf([&] { settings.set("FieldLength", "nan"); }), HasSubstr("out of range"));
  EXPECT_THAT(messageOf([&] { settings.set("FieldLength", "3kg"); }), HasSubstr("m, cm, mm"));
  EXPECT_THAT(messageOf([&] { settings.set("MaxTouchGroupSize", "2.5"); }), HasSubstr("whole number"));
  EXPECT_THAT(messageOf([&] { settings.set("UseCharging", "maybe"); }), HasSubstr("neither true nor false"));
  EXPECT_EQ(valuesOf(settings), valuesOf(Settings{}));
}

TEST(Settings, TomlOverlaysAndNamesFileAndLineOfErrors) {
  Settings settings;
  settings.overlayText(
      "RuleHalfTime = 60\n[Soccer]\nUseCharging = false\nSelfCollisionRecordFilename = \"x.txt\"\n",
      "a.toml");
  EXPECT_EQ(settings.ruleHalfTime, 60.0);
  EXPECT_FALSE(settings.useCharging);
  EXPECT_EQ(settings.selfCollisionRecordFilename, "x.txt");
  const auto before = valuesOf(settings);
  EXPECT_THAT(messageOf([&] { settings.overlayText("RuleHalfTime = 5\nGoalWdith = 3\n", "b.toml"); }),
              AllOf(HasSubstr("b.toml:2"), HasSubstr("did you mean 'GoalWidth'")));
  EXPECT_THAT(messageOf([&] { settings.overlayText("RuleHalfTime = \n", "b.toml"); }), HasSubstr("b.toml:1"));
  EXPECT_THAT(messageOf([&] { settings.overlayText("[Soccer]\nUseCharging = 3\n", "b.toml"); }),
              AllOf(HasSubstr("b.toml:2"), HasSubstr("true or false")));
  EXPECT_THAT(messageOf([&] { settings.overlayText("LeftTeam = 3\n", "b.toml"); }),
              AllOf(HasSubstr("b.toml:1"), HasSubstr("a text in quotes")));
  EXPECT_THAT(messageOf([&] { settings.overlayText("[Socker]\nUseCharging = true\n", "b.toml"); }),
              HasSubstr("did you mean 'Soccer'"));
  EXPECT_EQ(valuesOf(settings), before) << "an overlay that fails changes nothing";
  EXPECT_THAT(messageOf([&] { settings.overlayFile("/no/such.toml"); }), HasSubstr("/no/such.toml"));
}

TEST(Settings, FieldPresets) {
  Settings settings;
  settings.setField("21x14");
  EXPECT_EQ(settings.fieldLength, 21.0);
  EXPECT_EQ(settings.fieldWidth, 14.0);
  settings.setField("30x20");
  EXPECT_EQ(valuesOf(settings), valuesOf(Settings{}));
  EXPECT_THAT(messageOf([&] { settings.setField("9x6"); }), HasSubstr("30x20"));
}

// Each within its own range; the physics would end the process.
TEST(Settings, ABallThatDoesNotFitIntoTheGoalsIsAnError) {
  for (const auto& [name, value] : {std::pair{"GoalDepth", "0.05"}, std::pair{"BallRadius", "1"},
                                    std::pair{"GoalWidth", "0"}, std::pair{"GoalDepth", "0"}}) {
    Settings settings;
    settings.set(name, value);
    EXPECT_THAT(messageOf([&] { const Simulation simulation(settings); }),
                AllOf(HasSubstr("GoalDepth"), HasSubstr("GoalWidth"), HasSubstr("BallRadius"),
                      HasSubstr("make the goals larger or the ball smaller")))
        << name;
  }
}

TEST(Settings, WorldGetsTheGeometry) {
  Settings settings;
  settings.set("FieldLength", "21");
  settings.set("QuickSolver", "true");
  const WorldSettings world = settings.world();
  EXPECT_EQ(world.fieldLength, 21.0);
  EXPECT_EQ(world.solver, WorldSettings::Solver::Quick);
  EXPECT_EQ(world.ballRadius, 0.042);
}

TEST(Settings, TruthAndNoiseSwitches) {
  Settings settings;
  settings.senseTruth();
  settings.removeNoise();
  EXPECT_TRUE(settings.senseMyPos && settings.senseMyOrien && settings.senseBallPos);
  EXPECT_FALSE(settings.visionNoise);
  EXPECT_EQ(settings.beamNoiseXY, 0.0);
  EXPECT_EQ(settings.beamNoiseAngle, 0.0);
}

}  // namespace
}  // namespace nonet::sim
