// The regression against slopes that are known, and the whole against a kick that is spoilt by hand.
#include "nonet/lab/reports/kick_straighten.h"

#include <cmath>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "nonet/config/assignment.h"
#include "nonet/math/angle.h"
#include "nonet/math/random.h"

#include "lab/trial_setup.h"

namespace nonet::lab {
namespace {

const TurningInputs kTrueSlopes = (TurningInputs() << 3.0, -1.0, 0.4, -0.8, 0.2).finished();
const TurningInputs kInputMeans = (TurningInputs() << 0.015, 0.0, -0.02, 0.1, 0.03).finished();
const TurningInputs kInputSpread = (TurningInputs() << 0.006, 0.006, 0.02, 0.04, 0.05).finished();

std::vector<DirectionSample> kicksWith(double noise, int count) {
  Random random(5);
  std::vector<DirectionSample> samples;
  for (int i = 0; i < count; ++i) {
    DirectionSample sample;
    for (int k = 0; k < kTurningInputs; ++k)
      sample.inputs[k] = kInputMeans[k] + kInputSpread[k] * random.normal();
    sample.direction = 0.05 + kTrueSlopes.dot(sample.inputs - kInputMeans) + noise * random.normal();
    samples.push_back(sample);
  }
  return samples;
}

TEST(KickStraighten, FindsHowTheDirectionFollowsTheInputs) {
  const DirectionFit fit = fitDirection(kicksWith(0.01, 2000));
  for (int k = 0; k < kTurningInputs; ++k) {
    EXPECT_NEAR(fit.slopes[k] * kInputSpread[k], kTrueSlopes[k] * kInputSpread[k], 0.0015) << k;
    EXPECT_NEAR(fit.mean[k], kInputMeans[k], 0.1 * kInputSpread[k]) << k;
  }
  EXPECT_NEAR(fit.rest, 0.01, 0.001);
  const double told = kTrueSlopes.cwiseProduct(kInputSpread).norm();
  EXPECT_NEAR(fit.deviation, std::hypot(told, 0.01), 0.002);
}

TEST(KickStraighten, LeavesOutWhatStumbled) {
  std::vector<DirectionSample> samples = kicksWith(0.0, 300);
  const DirectionFit clean = fitDirection(samples);
  for (std::size_t i = 0; i < samples.size(); i += 10) {
    samples.push_back({samples[i].inputs, i % 20 == 0 ? 1.5 : -0.8});
  }
  EXPECT_LT((fitDirection(samples).slopes - clean.slopes).norm(), 1e-9);
}

// An input that is always the same tells nothing, and a ridge keeps it at nothing.
TEST(KickStraighten, AConstantInputHasNoSlope) {
  std::vector<DirectionSample> samples = kicksWith(0.01, 200);
  for (DirectionSample& sample : samples) sample.inputs[3] = 0.1;
  EXPECT_NEAR(fitDirection(samples).slopes[3], 0.0, 1e-9);
}

TEST(KickStraighten, AsksForMoreKicksThanAFew) {
  EXPECT_THAT([] { fitDirection(kicksWith(0.01, 15)); },
              testing::ThrowsMessage<std::runtime_error>(testing::HasSubstr("--trials")));
}

KickReportSettings settingsFor(int robotType, const std::string& kick) {
  KickReportSettings settings;
  settings.agent = agentOfType(robotType);
  settings.kick = kick;
  settings.trials = 40;
  settings.seed = 3;
  return settings;
}

double parameterOf(const KickReportSettings& settings, const char* name) {
  return *settings.agent.parameters.motion.skills.find(settings.kick, name);
}

TEST(KickStraighten, WhatDoesNotFitIsTold) {
  EXPECT_THAT([] { straightenKick(settingsFor(1, "kick_heel")); },
              testing::ThrowsMessage<std::runtime_error>(testing::HasSubstr("'yaw'")));
  EXPECT_THAT([] { straightenKick(settingsFor(1, "kick_nobody")); },
              testing::ThrowsMessage<std::runtime_error>(testing::HasSubstr("kick_power")));
}

// The kick believes that the ball goes 2 degrees farther to the left than it does, and turns its foot with
// the pace by half of what it should. (By nothing: a tenth of the kicks misses the ball, and no line fits.)
TEST(KickStraighten, ASpoiltKickIsStraightenedAgain) {
  KickReportSettings settings = settingsFor(1, "kick_power");
  agent::AgentChoice choice;
  choice.robotType = 1;
  choice.parameterFiles = {NONET_TEST_DATA "/kicks/power_type1.toml"};
  settings.agent = agent::makeAgentSettings(choice, NONET_SOURCE_DIR);
  const double veer = parameterOf(settings, "veer");
  config::assignParameter(settings.agent.parameters,
                          fmt::format("motion.skills.kick_power.veer={}", veer + 0.035));
  config::assignParameter(
      settings.agent.parameters,
      fmt::format("motion.skills.kick_power.yawPaceAhead={}", parameterOf(settings, "yawPaceAhead") - 0.4));
  const StraightenedKick result = straightenKick(settings);
  EXPECT_TRUE(result.turns);
  EXPECT_LT(result.authority, -0.4);
  EXPECT_GT(result.before.directionError.mean, toRadians(1.2));
  EXPECT_LT(result.after.directionError.mean, 0.6 * result.before.directionError.mean);
  EXPECT_LT(std::abs(result.directionAfter.median), toRadians(0.5));
  EXPECT_TRUE(result.better);
  ASSERT_EQ(result.parameters.size(), 7U);
  EXPECT_EQ(result.parameters[0].name, "veer");
  EXPECT_NEAR(result.parameters[0].before, veer + 0.035, 1e-9);
  EXPECT_NE(result.parameters[0].after, result.parameters[0].before);
  EXPECT_THAT(straightenedTable(result), testing::HasSubstr("straighter, and as good"));
  EXPECT_THAT(straightenedToml(result),
              testing::AllOf(testing::HasSubstr("[motion.skills.kick_power]\nveer = "),
                             testing::HasSubstr("\nyawPaceAside = ")));
}

}  // namespace
}  // namespace nonet::lab
