// Shots at a goalie, from above, and where they would cross the goal line.
#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "nonet/lab/reports/save_report.h"
#include "nonet/world/world_state.h"

#include "lab/common/plot.h"

namespace nonet::lab {

namespace {

constexpr double kSaveWidth = 800.0;
constexpr double kFrontWidth = 520.0;  // of the goal seen from the field
constexpr const char* kSaved = "#2070a0";
constexpr const char* kGoal = "#c03030";
constexpr const char* kFrame = "#555";
const world::FieldGeometry kField;

const char* outcomeOf(const Save& save) {
  return save.saved ? "saved" : "goal";
}
const char* colorOf(const Save& save) {
  return save.saved ? kSaved : kGoal;
}

Plot fromAbove(const SaveReport& report) {
  Plot plot;
  plot.title = "from above, true to scale";
  plot.xLabel = "from the goal line into the field, m";
  plot.yLabel = "to the left of the middle as the goalie looks, m";
  plot.legend = false;
  const double post = 0.5 * kField.goalWidth;
  double far = 3.0;
  double aside = post + kPlotRoom;
  PlotDots goalie{"where the goalie stood at the shot", kFrame, {}, {}, 2.0};
  for (const Save& save : report.saves) {
    PlotCurve way{outcomeOf(save), colorOf(save), {}, {}};
    way.opacity = 0.4;
    for (const Vector3& p : save.path) {
      way.x.push_back(p.x() + 0.5 * kField.length);
      way.y.push_back(p.y());
      far = std::max(far, way.x.back());
      aside = std::max(aside, std::abs(p.y()));
    }
    plot.curves.push_back(std::move(way));
    goalie.x.push_back(save.X_WStart.translation.x() + 0.5 * kField.length);
    goalie.y.push_back(save.X_WStart.translation.y());
  }
  plot.dots.push_back(std::move(goalie));
  const double back = -kField.goalDepth;
  plot.curves.push_back({"goal", kFrame, {0.0, back, back, 0.0}, {post, post, -post, -post}, false, 2.0});
  plot.curves.push_back({"", kFrame, {0.0, 0.0}, {-aside - kPlotRoom, aside + kPlotRoom}});
  plot.left = back - 0.2;
  plot.right = far + kPlotRoom;
  plot.low = -aside - kPlotRoom;
  plot.high = aside + kPlotRoom;
  return plot;
}

Plot fromTheField(const SaveReport& report) {
  Plot plot;
  plot.title = "where the ball would cross the goal line if nobody touched it, seen from the field";
  plot.xLabel = "to the left of the middle as the goalie looks, m";
  plot.yLabel = "height of the centre, m";
  plot.legend = false;
  const double post = 0.5 * kField.goalWidth;
  const double bar = kField.goalHeight;
  plot.curves.push_back({"", kFrame, {-post, -post, post, post}, {0.0, bar, bar, 0.0}, false, 3.0});
  for (const Save& save : report.saves) {
    const auto crossing = freeCrossing(save.shot);
    if (!crossing) continue;
    const bool rolling = save.shot.kind == ShotKind::Rolling;
    plot.dots.push_back({fmt::format("{}, {}", outcomeOf(save), rolling ? "rolling" : "flying"),
                         colorOf(save),
                         {crossing->y},
                         {crossing->height},
                         rolling ? 2.5 : 5.0});
  }
  plot.left = -post - 0.2;
  plot.right = post + 0.2;
  plot.low = 0.0;
  plot.high = bar + 0.2;
  return plot;
}

}  // namespace

std::string saveReportSvg(const SaveReport& report, const SaveReportSettings& settings) {
  const Plot above = fromAbove(report);
  const Plot front = fromTheField(report);
  const PlotBox first = trueToScale(above, kPlotMargin.left, kPictureHead + kPlotMargin.top,
                                    kSaveWidth - kPlotMargin.left - kPlotMargin.right);
  const double legendAt = first.top + first.height + kPlotMargin.bottom + 20.0;
  const PlotBox second = trueToScale(front, kPlotMargin.left, legendAt + 14.0 + kPlotMargin.top, kFrontWidth);
  std::string svg = fmt::format(
      "<text x='14' y='22' font-size='15' font-weight='bold'>Goalie of type {}: {} shots, {:.1f} % saved "
      "(rolling {:.1f} %, flying {:.1f} %)</text>\n",
      settings.goalie.robotType, report.all.trials, 100.0 * report.all.savedShare(),
      100.0 * report.rolling.savedShare(), 100.0 * report.flying.savedShare());
  svg += drawLegend(legendOf(above), 14.0, 46.0) + drawPlot(above, first);
  svg += drawLegend(legendOf(front), 14.0, legendAt) + drawPlot(front, second);
  return svgPicture(kSaveWidth, second.top + second.height + kPlotMargin.bottom, svg);
}

}  // namespace nonet::lab
