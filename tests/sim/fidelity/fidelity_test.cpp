// The embedded physics against recordings of the real server: the same trajectory, digit by digit.
#include "nonet/sim/fidelity/fidelity.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

namespace nonet::sim {
namespace {

// Coordinates are recorded with six significant digits: beyond 10 m the last one is 0.1 mm, and half of that
// per axis is rounding.
constexpr double kRounding = 9e-5;  // m

std::filesystem::path recordingFile(const std::string& scenario) {
  return std::filesystem::path(NONET_TEST_DATA) / "physics" / (scenario + ".jsonl.gz");
}

std::vector<std::string> scenarios() {
  std::vector<std::string> names;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(NONET_TEST_DATA) / "physics")) {
    const std::string name = entry.path().filename().string();
    if (name.ends_with(".jsonl.gz")) names.push_back(name.substr(0, name.size() - 9));
  }
  std::sort(names.begin(), names.end());
  return names;
}

class Fidelity : public testing::TestWithParam<std::string> {};

TEST_P(Fidelity, FollowsTheRecordingToItsLastDigit) {
  const FidelityResult result = replay(readRecording(recordingFile(GetParam())));
  EXPECT_TRUE(result.knownHistory);
  EXPECT_LT(result.worst.position(), kRounding);
  EXPECT_EQ(result.worst.joints, 0.0);
  EXPECT_EQ(result.worst.gyro, 0.0);
  EXPECT_EQ(result.worst.accelerometer, 0.0);
  EXPECT_EQ(result.worst.footForce, 0.0);
  EXPECT_EQ(result.worst.footCenter, 0.0);
  EXPECT_EQ(result.worst.footContacts, 0);
  EXPECT_FALSE(result.firstOver[0]);
}

INSTANTIATE_TEST_SUITE_P(Recorded, Fidelity, testing::ValuesIn(scenarios()),
                         [](const auto& info) { return info.param; });

// The quick stepper solves the same equations; only rounding differs, which walking amplifies after some
// seconds.
TEST_P(Fidelity, QuickStepperFollowsTheRecordingToo) {
  const WorldSettings quick{.solver = WorldSettings::Solver::Quick};
  const FidelityResult result = replay(readRecording(recordingFile(GetParam())), quick);
  EXPECT_TRUE(result.knownHistory);
  EXPECT_LT(result.worstPositionBefore(5.0), kRounding);
  if (GetParam().starts_with("walk_until_fall") || GetParam().starts_with("step_in_place")) return;
  EXPECT_LT(result.worst.position(), kRounding);
  EXPECT_LT(result.worst.joints, 0.011);
  EXPECT_EQ(result.worst.footContacts, 0);
}

TEST(FidelityStart, UnknownExperimentThatBeginsStandingIsStillExact) {
  Recording recording = readRecording(recordingFile("kick"));
  recording.scenario = "something else";
  const FidelityResult result = replay(recording);
  EXPECT_TRUE(result.knownHistory);
  EXPECT_LT(result.worst.position(), kRounding);
  EXPECT_EQ(result.worst.footForce, 0.0);
}

TEST(FidelityStart, UnknownExperimentIsTakenUpFromItsFirstTwoCycles) {
  Recording recording = readRecording(recordingFile("walk_until_fall"));
  recording.scenario = "something else";
  const FidelityResult result = replay(recording);
  EXPECT_FALSE(result.knownHistory);
  EXPECT_LT(result.worstPositionBefore(1.0), 1e-4);
  EXPECT_LT(result.worstPositionBefore(2.0), 1e-3);
}

// The comparison itself: a wrong command must show.
TEST(FidelityComparison, NoticesOneWrongCommand) {
  Recording recording = readRecording(recordingFile("joint_pulses_standing"));
  ASSERT_GT(recording.cycles.size(), 40U);
  recording.cycles[20].robots[0].speeds = {{model::JointId::LArm1, 1.0F}};
  const FidelityResult result = replay(recording);
  EXPECT_LT(result.worstPositionBefore(21 * 0.02), kRounding);
  EXPECT_GT(result.worst.joints, 1.0);
  ASSERT_TRUE(result.firstOver[0]);
  EXPECT_NEAR(*result.firstOver[0], 22 * 0.02, 1e-9);
}

TEST(FidelityRecording, NamesFileAndLineOfDamage) {
  const auto file = std::filesystem::temp_directory_path() / "nonet_damaged_recording.jsonl";
  std::ofstream(file) << "{\"scenario\":\"x\"}\n{\"t\":0.0,\"ball\":[0,0]}\n";
  try {
    readRecording(file);
    FAIL() << "damage was not noticed";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("nonet_damaged_recording.jsonl:2"), std::string::npos)
        << error.what();
  }
  std::filesystem::remove(file);
  EXPECT_THROW(readRecording(file), std::runtime_error);
}

TEST(FidelityDrawing, ShowsBothCurves) {
  const std::string svg = drawFidelity(replay(readRecording(recordingFile("settle"))));
  EXPECT_NE(svg.find("<svg"), std::string::npos);
  EXPECT_EQ(std::count(svg.begin(), svg.end(), '<') > 10, true);
  EXPECT_NE(svg.find("polyline"), svg.rfind("polyline"));
  for (const char* text : {">time, s<", ">position error, m<", ">0.1 mm<", ">1 mm<", ">1 cm<", ">ball<"})
    EXPECT_NE(svg.find(text), std::string::npos) << text;
}

}  // namespace
}  // namespace nonet::sim
