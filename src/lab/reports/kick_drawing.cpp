// The balls' ways after kicks, from above and from the side.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "nonet/lab/reports/kick_report.h"
#include "nonet/math/angle.h"
#include "nonet/world/world_state.h"

#include "lab/common/plot.h"

namespace nonet::lab {

namespace {

constexpr double kSideHeight = 150.0;  // of the view from the side
constexpr double kBeside = 10.0;       // deg, of the lines that show what is still straight
constexpr const char* kLine = "#777";

PlotCurve curveOf(const Kick& kick, bool fromAbove) {
  PlotCurve curve;
  curve.name = kick.fell ? "the robot fell" : kick.tooShort() ? "under 2 m" : "2 m or more";
  curve.color = kick.fell ? "#c03030" : kick.tooShort() ? "#e09000" : "#2070a0";
  curve.opacity = 0.5;
  for (const Vector3& p : kick.path) {
    curve.x.push_back(p.x());
    curve.y.push_back(fromAbove ? p.y() : p.z());
  }
  return curve;
}

// Both views have the same ends along the bottom, whole metres, so that they stand below each other.
Plot viewOf(const KickMeasures& kick, bool fromAbove) {
  Plot plot;
  plot.legend = false;
  plot.left = -kPlotRoom;
  double farthest = 2.0;
  for (const Kick& one : kick.kicks) {
    plot.curves.push_back(curveOf(one, fromAbove));
    for (const Vector3& p : one.path) {
      farthest = std::max(farthest, p.x());
      plot.left = std::min(*plot.left, p.x());
    }
  }
  plot.right = std::ceil(farthest);
  plot.xLabel = "from where the ball lay towards the target, m";
  return plot;
}

Plot fromAbove(const KickMeasures& kick) {
  Plot plot = viewOf(kick, true);
  plot.title = "from above, true to scale";
  plot.yLabel = "to the left, m";
  double aside = 1.0;
  for (const Kick& one : kick.kicks) {
    for (const Vector3& p : one.path) aside = std::max(aside, std::abs(p.y()));
  }
  plot.low = -aside - kPlotRoom;
  plot.high = aside + kPlotRoom;
  plot.curves.push_back({"towards the target", kLine, {0.0, *plot.right}, {0.0, 0.0}});
  const double reach = std::min(*plot.right, *plot.high / std::tan(toRadians(kBeside)));
  for (const double side : {-1.0, 1.0}) {
    plot.curves.push_back({fmt::format("{:.0f} degrees beside it", kBeside),
                           kLine,
                           {0.0, reach},
                           {0.0, side * reach * std::tan(toRadians(kBeside))},
                           true});
  }
  return plot;
}

Plot fromTheSide(const KickMeasures& kick) {
  Plot plot = viewOf(kick, false);
  plot.title = "from the side, heights enlarged";
  plot.yLabel = "height of the centre, m";
  const double crossbar = world::FieldGeometry{}.goalHeight;
  double highest = 1.2 * crossbar;
  for (const Kick& one : kick.kicks) {
    for (const Vector3& p : one.path) highest = std::max(highest, 1.05 * p.z());
  }
  plot.low = 0.0;
  plot.high = highest;
  plot.limits = {{crossbar, "as high as the crossbar", kLine}};
  return plot;
}

}  // namespace

std::string kickReportSvg(const KickMeasures& kick, const KickReportSettings& settings) {
  const Plot above = fromAbove(kick);
  const Plot side = fromTheSide(kick);
  const double width = kPictureWidth - kPlotMargin.left - kPlotMargin.right;
  const PlotBox box = trueToScale(above, kPlotMargin.left, kPictureHead + kPlotMargin.top, width);
  const double second = box.top + box.height + kPlotMargin.bottom + kPlotMargin.top;
  std::string svg = fmt::format(
      "<text x='14' y='22' font-size='15' font-weight='bold'>{}, robot type {}: {} kicks from {:.2g} m away, "
      "{:.1f} m in the mean, {:.1f} deg beside the target</text>\n",
      xmlText(kick.name), settings.agent.robotType, kick.trials, settings.start, kick.distance.mean,
      toDegrees(kick.directionError.mean));
  svg += drawLegend(legendOf(above), 14.0, 46.0);
  svg += drawPlot(above, box) + drawPlot(side, {box.left, second, width, kSideHeight});
  return svgPicture(kPictureWidth, second + kSideHeight + kPlotMargin.bottom, svg);
}

}  // namespace nonet::lab
