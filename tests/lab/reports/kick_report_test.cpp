// Kicks with their approach, at reduced counts: `nonet kick-report` measures a hundred of each.
#include "nonet/lab/reports/kick_report.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "nonet/math/angle.h"

#include "lab/trial_setup.h"

namespace nonet::lab {
namespace {

KickReportSettings reportOf(int type) {
  KickReportSettings settings;
  settings.agent = agentOfType(type);
  return settings;
}

class Kicking : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Types, Kicking, testing::Range(0, model::kRobotTypeCount));

TEST_P(Kicking, GoesFarAndStraightFromAllSides) {
  KickReportSettings settings = reportOf(GetParam());
  settings.kick = "any";
  settings.trials = 100;
  const KickMeasures kicks = measureKicks(settings).at(0);
  EXPECT_GT(kicks.distance.median, 5.5);
  EXPECT_GT(kicks.distance.p10, 4.5);
  EXPECT_LT(kicks.under2m, 0.06);
  EXPECT_LT(kicks.falls, 0.15);
  EXPECT_GT(kicks.withinTen, 0.9);
  EXPECT_LT(kicks.time.median, 6.0);
}

TEST(KickReport, DoesNotDependOnTheNumberOfThreads) {
  KickReportSettings settings = reportOf(0);
  settings.kick = kickNames(settings.agent).at(0);
  settings.trials = 3;
  settings.threads = 1;
  const std::string alone = kickReportJson(measureKicks(settings), settings);
  settings.threads = 3;
  EXPECT_EQ(kickReportJson(measureKicks(settings), settings), alone);
}

TEST(KickReport, NamesTheKicksWhenThereIsNoneOfThatName) {
  KickReportSettings settings = reportOf(0);
  settings.kick = "kick_nowhere";
  try {
    measureKicks(settings);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find(kickNames(settings.agent).at(0)), std::string::npos);
  }
}

TEST(KickReport, MeasuresTheFanOfTheBallsWays) {
  KickReportSettings settings = reportOf(4);
  settings.kick = "any";
  settings.trials = 2;
  const KickMeasures kicks = measureKicks(settings).at(0);
  const std::string svg = kickReportSvg(kicks, settings);
  EXPECT_GT(std::count(svg.begin(), svg.end(), '\n'), 20);
  for (const Kick& kick : kicks.kicks) {
    EXPECT_EQ(kick.path.empty(), !kick.contact);
  }
}

}  // namespace
}  // namespace nonet::lab
