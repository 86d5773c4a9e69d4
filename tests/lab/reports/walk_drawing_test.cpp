// What is written in the pictures of a walk.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "nonet/lab/reports/walk_report.h"

#include "lab/trial_setup.h"

namespace nonet::lab {
namespace {

using testing::HasSubstr;

// Rings every 0.2 m/s, 1.0 at the border: 0.5 m/s ahead is half of the radius above the centre.
TEST(WalkDrawing, HasForwardAboveAndNamesTheType) {
  WalkReport report;
  report.robotType = 3;
  report.steady.fill({0.25, 0.0});
  report.steady[0].mean = 1.0;
  report.steady[4].mean = 0.5;
  const std::string svg = walkReportSvg(report);
  for (const char* text : {"robot type 3: walking speed by direction, m/s", ">forward<", ">left<",
                           ">backward<", ">right<", ">steady<", ">first 3 s from a stand<", ">0.2<", ">1.0<"})
    EXPECT_THAT(svg, HasSubstr(text));
  EXPECT_THAT(svg, HasSubstr("stroke='#2060c0' stroke-width='2' points='300.0,80.0 "));
  EXPECT_THAT(svg, HasSubstr(" 190.0,300.0 "));
}

TEST(WalkDrawing, OfACourseHasTimeAndUnits) {
  const std::string svg = walkTraceSvg(agentTrialSettings(0), Pose2(10.0, 0.0, 0.0), 0.4);
  for (const char* text : {"robot type 0", ">time, s<", ">m<", ">deg<", ">desired<", ">measured<",
                           ">soles above the torso<", ">pitch, forward<", "class='tick'"})
    EXPECT_THAT(svg, HasSubstr(text));
}

}  // namespace
}  // namespace nonet::lab
