#include "lab/common/plot.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace nonet::lab {
namespace {

using testing::DoubleNear;
using testing::HasSubstr;
using testing::Not;
using testing::Pointwise;

int count(const std::string& text, const std::string& part) {
  int count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(Ticks, AreRound) {
  EXPECT_THAT(roundTicks(0.0, 1.0, 5), Pointwise(DoubleNear(1e-12), {0.0, 0.2, 0.4, 0.6, 0.8, 1.0}));
  EXPECT_THAT(roundTicks(-33.0, 41.0, 4), Pointwise(DoubleNear(1e-12), {-20.0, 0.0, 20.0, 40.0}));
  EXPECT_THAT(roundTicks(0.0123, 0.0181, 3), Pointwise(DoubleNear(1e-12), {0.014, 0.016, 0.018}));
}

// Never many more than asked for, whatever the range, and all inside.
TEST(Ticks, AreAsManyAsAskedForAtMost) {
  for (double low = -3.7; low < 4.0; low += 0.61) {
    for (double span = 1e-4; span < 1e5; span *= 2.7) {
      const std::vector<double> ticks = roundTicks(low, low + span, 6);
      EXPECT_GE(ticks.size(), 2U) << low << " " << span;
      EXPECT_LE(ticks.size(), 7U) << low << " " << span;
      EXPECT_GE(ticks.front(), low - 1e-6 * span);
      EXPECT_LE(ticks.back(), low + span * (1.0 + 1e-6));
    }
  }
}

TEST(Ticks, HaveTheDigitsThatTheyNeed) {
  EXPECT_EQ(tickText(0.4, {0.2, 0.4}), "0.4");
  EXPECT_EQ(tickText(20.0, {0.0, 20.0}), "20");
  EXPECT_EQ(tickText(0.014, {0.014, 0.016}), "0.014");
}

TEST(Plots, SayWhatTheyShow) {
  Plot plot;
  plot.title = "left.knee & <toe>";
  plot.xLabel = "time, s";
  plot.yLabel = "angle, deg";
  const double gap = std::numeric_limits<double>::quiet_NaN();
  plot.curves = {{"told", "#123456", {0.0, 1.0, 2.0, 3.0}, {0.0, 1.0, gap, 2.0}, false},
                 {"", "#654321", {0.0, 3.0}, {1.0, 1.0}, true}};
  plot.limits = {{1.5, "limit", "red"}, {100.0, "far away", "red"}};
  plot.marks = {{2.5, "17", "grey"}};
  const std::string svg = drawPlot(plot, {60.0, 20.0, 300.0, 100.0});
  EXPECT_THAT(svg, HasSubstr(">left.knee &amp; &lt;toe&gt;<"));
  for (const std::string text : {">time, s<", ">angle, deg<", ">told<", ">limit<", ">17<"})
    EXPECT_THAT(svg, HasSubstr(text));
  EXPECT_THAT(svg, Not(HasSubstr("far away")));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_EQ(count(svg, "<polyline"), 3);  // the gap makes two of one
  EXPECT_GE(count(svg, "class='tick'"), 3);
}

// A value of 2 on an axis from 0 to 4 stands in the middle of the frame.
TEST(Plots, PutValuesWhereTheAxesSay) {
  Plot plot;
  plot.low = 0.0;
  plot.high = 4.0;
  plot.curves = {{"", "blue", {0.0, 1.0, 2.0}, {0.0, 2.0, 4.0}, false}};
  EXPECT_THAT(drawPlot(plot, {100.0, 50.0, 200.0, 80.0}),
              HasSubstr("points='100.0,130.0 200.0,90.0 300.0,50.0 '"));
}

// A metre is as long upwards as along: 4 m by 2 m in a frame 200 wide.
TEST(Plots, TrueToScaleHaveTheHeightThatTheirRangesAsk) {
  Plot plot;
  plot.left = -1.0;
  plot.right = 3.0;
  plot.low = 0.0;
  plot.high = 2.0;
  plot.dots = {{"spots", "blue", {0.0, 1.0}, {1.0, 2.0}, 3.0}};
  const PlotBox box = trueToScale(plot, 60.0, 20.0, 200.0);
  EXPECT_DOUBLE_EQ(box.height, 100.0);
  const std::string svg = drawPlot(plot, box);
  EXPECT_THAT(svg, HasSubstr("<circle cx='110.0' cy='70.0' r='3.0'/><circle cx='160.0' cy='20.0'"));
}

TEST(Plots, NameEachKindOnceInTheLegend) {
  Plot plot;
  plot.curves = {{"kick", "blue", {0.0}, {0.0}}, {"kick", "blue", {0.0}, {1.0}}, {"", "red", {0.0}, {1.0}}};
  plot.dots = {{"goalie", "grey", {0.0}, {0.0}, 2.0}};
  const std::vector<LegendEntry> legend = legendOf(plot);
  ASSERT_EQ(legend.size(), 2U);
  EXPECT_EQ(legend[0].name, "kick");
  EXPECT_EQ(legend[1].dot, 2.0);
  EXPECT_THAT(drawLegend(legend, 0.0, 0.0), HasSubstr("r='2.0' fill='grey'"));
}

TEST(Plots, OfNothingAreEmpty) {
  Plot plot;
  plot.curves = {{"none", "blue", {}, {}, false}};
  const std::string svg = drawPlot(plot, {60.0, 20.0, 300.0, 100.0});
  EXPECT_EQ(count(svg, "<polyline"), 0);
  EXPECT_THAT(svg, Not(HasSubstr("inf")));
}

}  // namespace
}  // namespace nonet::lab
