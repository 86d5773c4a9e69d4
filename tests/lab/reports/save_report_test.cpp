// Shares of the save report, against saves made up by hand; and that it says what the JSON promises.
#include "nonet/lab/reports/save_report.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "nonet/agent/agent_setup.h"

namespace nonet::lab {
namespace {

TEST(SaveReport, CountsWhatHappened) {
  std::vector<Save> saves(5);
  saves[0].saved = saves[0].touched = saves[0].cleared = true;
  saves[1].saved = saves[1].touched = saves[1].fell = saves[1].up = true;
  saves[1].riseTime = 3.0;
  saves[2].fell = true;
  saves[2].riseTime = 1.0;
  saves[3].ownGoal = saves[3].touched = true;
  const SaveStatistics s = saveStatistics(saves);
  EXPECT_EQ(s.trials, 5);
  EXPECT_DOUBLE_EQ(s.savedShare(), 0.4);
  EXPECT_EQ(s.touched, 3);
  EXPECT_EQ(s.falls, 2);
  EXPECT_EQ(s.upAgain, 1);
  EXPECT_DOUBLE_EQ(s.riseTime, 2.0);
  EXPECT_EQ(s.ownGoals, 1);
  EXPECT_EQ(s.cleared, 1);
  EXPECT_EQ(saveStatistics({}).savedShare(), 0.0);
}

TEST(SaveReport, ChallengeRepeatsTheSameTwelveShots) {
  const std::vector<Shot> shots = challengeShots(7);
  ASSERT_EQ(shots.size(), 12U);
  const std::vector<Shot> again = challengeShots(7);
  for (std::size_t i = 0; i < shots.size(); ++i) {
    EXPECT_EQ(shots[i].v_WB, again[i].v_WB);
    EXPECT_EQ(shots[i].kind, i % 2 == 0 ? ShotKind::Rolling : ShotKind::Flying);
  }
  EXPECT_NE(challengeShots(8)[0].v_WB, shots[0].v_WB);
}

TEST(SaveReport, DoesNotDependOnTheNumberOfThreadsAndSpeaksJson) {
  SaveReportSettings settings;
  settings.goalie = agent::makeAgentSettings({}, NONET_SOURCE_DIR);
  settings.trials = 2;
  settings.quickSolver = true;
  settings.threads = 1;
  int calls = 0;
  settings.progress = [&](const std::string& what, int done, int all) {
    EXPECT_EQ(what, "shots");
    EXPECT_EQ(done, ++calls);
    EXPECT_EQ(all, 4);
  };
  const std::string text = saveReportJson(measureSaves(settings), settings);
  EXPECT_EQ(calls, 4);
  settings.threads = 2;
  settings.progress = {};
  EXPECT_EQ(saveReportJson(measureSaves(settings), settings), text);
  const auto json = nlohmann::json::parse(text);
  EXPECT_TRUE(json["saved_share"].is_number());
  EXPECT_EQ(json["rolling"]["trials"], 2);
  EXPECT_EQ(json["flying"]["trials"], 2);
  EXPECT_EQ(json["shots"].size(), 4U);
}

}  // namespace
}  // namespace nonet::lab
