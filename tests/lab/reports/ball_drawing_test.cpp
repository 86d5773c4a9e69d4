// What is written in the pictures of kicks, shots and the slalom, and where a way ends in them.
#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "nonet/lab/reports/ball_report.h"
#include "nonet/lab/reports/kick_report.h"
#include "nonet/lab/reports/save_report.h"
#include "nonet/math/angle.h"

namespace nonet::lab {
namespace {

using testing::HasSubstr;
using testing::Not;

// The frame holds -0.5 m to 10 m in 926 units from 62 on, so 10 m lie at its right end and 4.75 m in the
// middle.
TEST(KickDrawing, HasBothViewsWithUnitsAndALegend) {
  KickMeasures kicks;
  kicks.name = "kick_power";
  kicks.trials = 2;
  kicks.kicks.resize(2);
  kicks.kicks[0].forward = 10.0;
  kicks.kicks[0].path = {{0.0, 0.0, 0.04}, {4.75, 0.0, 0.5}, {10.0, 0.0, 0.04}};
  kicks.kicks[1].fell = true;
  kicks.kicks[1].path = {{0.0, 0.0, 0.04}, {3.0, 1.0, 0.04}};
  KickReportSettings settings;
  settings.agent.robotType = 3;
  const std::string svg = kickReportSvg(kicks, settings);
  for (const char* text : {"kick_power, robot type 3: 2 kicks from 0.5 m away", ">to the left, m<",
                           ">from where the ball lay towards the target, m<", ">height of the centre, m<",
                           ">2 m or more<", ">the robot fell<", ">10 degrees beside it<", "the crossbar"})
    EXPECT_THAT(svg, HasSubstr(text));
  EXPECT_THAT(svg, Not(HasSubstr(">under 2 m<"))) << "there was none";
  EXPECT_THAT(svg, HasSubstr(" 525.0,"));
  EXPECT_THAT(svg, HasSubstr(" 988.0,"));
}

TEST(SaveDrawing, ShowsShotsFromAboveAndFromTheField) {
  SaveReport report;
  report.saves.resize(2);
  report.saves[0].saved = true;
  report.saves[1].shot.kind = ShotKind::Flying;
  for (Save& save : report.saves) {
    save.shot.p_WB = Vector3(-12.0, 0.0, 0.042);
    save.shot.v_WB = Vector3(-6.0, 0.0, 0.0);
    save.path = {save.shot.p_WB, Vector3(-15.0, 0.3, 0.042)};
  }
  report.all = saveStatistics(report.saves);
  SaveReportSettings settings;
  settings.goalie.robotType = 4;
  const std::string svg = saveReportSvg(report, settings);
  for (const char* text :
       {"Goalie of type 4: 2 shots, 50.0 % saved", ">from the goal line into the field, m<", ">saved<",
        ">goal<", ">where the goalie stood at the shot<", ">saved, rolling<", ">goal, flying<",
        ">height of the centre, m<"})
    EXPECT_THAT(svg, HasSubstr(text));
}

// Two paths that turn to other sides first fall together: both ways end at the same point.
TEST(SlalomDrawing, LaysAllPathsOverEachOther) {
  BallReportSettings settings;
  std::vector<Dribble> slaloms(2);
  for (std::size_t i = 0; i < 2; ++i) {
    slaloms[i].path = slalomPath(Pose2(1.0, 2.0, 0.7), 6, (i == 0 ? 1.0 : -1.0) * toRadians(60.0), 2.0);
    for (const Vector2& corner : slaloms[i].path.corners) slaloms[i].track.push_back({0.0, corner, Pose2()});
  }
  slaloms[1].arrived = true;
  const std::string svg = slalomSvg(slaloms, settings);
  for (const char* text : {"2 trials", ">along the middle line, m<", ">to the left, m<", ">lost<", ">path<",
                           ">kept near the feet to the end<"})
    EXPECT_THAT(svg, HasSubstr(text));
  std::vector<std::string> ways;
  constexpr std::string_view kBegin = "points='";
  for (std::size_t at = svg.find(kBegin); at != std::string::npos; at = svg.find(kBegin, at + 1)) {
    const std::size_t from = at + kBegin.size();
    ways.push_back(svg.substr(from, svg.find('\'', from) - from));
  }
  ASSERT_EQ(ways.size(), 3U);
  EXPECT_EQ(ways[0], ways[1]);
  EXPECT_EQ(ways[0], ways[2]) << "the path itself";
}

}  // namespace
}  // namespace nonet::lab
