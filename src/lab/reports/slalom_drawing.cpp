// The ball's ways through the slalom.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "nonet/lab/reports/ball_report.h"

#include "lab/common/plot.h"

namespace nonet::lab {

namespace {

// From the begin along the middle line, the first turn to the right, so that all trials fall together.
class PathFrame {
 public:
  explicit PathFrame(const std::vector<Vector2>& corners) {
    const Vector2 middle = 0.5 * (corners[2] - corners[0]);
    X_PW_ = Pose2(corners[0], std::atan2(middle.y(), middle.x())).inverse();
    side_ = (X_PW_ * corners[1]).y() < 0.0 ? -1.0 : 1.0;
  }
  void add(const Vector2& p_W, PlotCurve& curve) const {
    const Vector2 p = X_PW_ * p_W;
    curve.x.push_back(p.x());
    curve.y.push_back(side_ * p.y());
  }

 private:
  Pose2 X_PW_;
  double side_ = 1.0;
};

PlotCurve wayOf(const Dribble& slalom, const PathFrame& frame) {
  PlotCurve way{"kept near the feet to the end", "#2070a0", {}, {}};
  if (slalom.lost || !slalom.arrived) way = {"lost", "#e09000", {}, {}};
  if (slalom.fell) way = {"the robot fell", "#c03030", {}, {}};
  way.opacity = 0.5;
  for (const BallSample& sample : slalom.track) frame.add(sample.ball, way);
  return way;
}

}  // namespace

std::string slalomSvg(const std::vector<Dribble>& slaloms, const BallReportSettings& settings) {
  Plot plot;
  plot.title = "from above, true to scale";
  plot.xLabel = "along the middle line, m";
  plot.yLabel = "to the left, m";
  plot.legend = false;
  PlotCurve path{"path", "#555", {}, {}, true};
  for (const Dribble& slalom : slaloms) {
    if (slalom.path.corners.size() < 3) continue;
    const PathFrame frame(slalom.path.corners);
    plot.curves.push_back(wayOf(slalom, frame));
    if (!path.x.empty()) continue;
    for (const Vector2& corner : slalom.path.corners) frame.add(corner, path);
  }
  plot.curves.push_back(std::move(path));
  plot.left = -kPlotRoom;
  plot.right = 1.0;
  plot.low = -1.0;
  plot.high = 1.0;
  for (const PlotCurve& curve : plot.curves) {
    for (const double x : curve.x) {
      plot.left = std::min(*plot.left, x - kPlotRoom);
      plot.right = std::max(*plot.right, x + kPlotRoom);
    }
    for (const double y : curve.y) {
      plot.low = std::min(*plot.low, y - kPlotRoom);
      plot.high = std::max(*plot.high, y + kPlotRoom);
    }
  }
  const PlotBox box = trueToScale(plot, kPlotMargin.left, kPictureHead + kPlotMargin.top,
                                  kPictureWidth - kPlotMargin.left - kPlotMargin.right);
  const std::string head = fmt::format(
      "<text x='14' y='22' font-size='15' font-weight='bold'>The ball's ways in the slalom, robot type {}: "
      "{} "
      "trials, six turns of 60 degrees 2 m apart</text>\n",
      settings.agent.robotType, slaloms.size());
  return svgPicture(kPictureWidth, box.top + box.height + kPlotMargin.bottom,
                    head + drawLegend(legendOf(plot), 14.0, 46.0) + drawPlot(plot, box));
}

}  // namespace nonet::lab
