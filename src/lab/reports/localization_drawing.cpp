// The map of a localization report, with the errors over time below it.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "nonet/lab/reports/localization_report.h"
#include "nonet/math/angle.h"

#include "lab/common/plot.h"

namespace nonet::lab {

namespace {

constexpr double kBorder = 1.3;  // m around the field
constexpr double kPlotHeight = 110.0;
constexpr double kJump = 0.5;  // m between two messages: the robot was put somewhere else
constexpr const char* kTruth = "#c03020";
constexpr const char* kTrueWay = "#f2a08c";  // wide, below the belief: usually they differ by a centimetre
constexpr const char* kBelief = "#2050c0";

/// From the field to the picture: x to the right, y up.
struct Map {
  double scale = 1.0;                // picture units a metre
  Vector2 corner = Vector2::Zero();  // upper left one, m

  double x(double metres) const { return scale * (metres - corner.x()); }
  double y(double metres) const { return kPictureHead + scale * (corner.y() - metres); }
};

std::string rectangle(const Map& map, double x, double y, double width, double height) {
  return fmt::format("<rect x='{:.1f}' y='{:.1f}' width='{:.1f}' height='{:.1f}'/>\n", map.x(x), map.y(y),
                     map.scale * width, map.scale * height);
}

std::string ground(const Map& map, const world::FieldGeometry& field) {
  const double x = 0.5 * field.length;
  const double y = 0.5 * field.width;
  const double area = 0.5 * field.areaWidth;
  const double goal = 0.5 * field.goalWidth;
  std::string svg =
      fmt::format("<g fill='#eef4ea' stroke='none'>{}</g>\n<g fill='none' stroke='#8aa080'>\n",
                  rectangle(map, -x - kBorder, y + kBorder, 2 * (x + kBorder), 2 * (y + kBorder)));
  svg += rectangle(map, -x, y, 2 * x, 2 * y);
  svg += rectangle(map, -x, area, field.areaLength, 2 * area);
  svg += rectangle(map, x - field.areaLength, area, field.areaLength, 2 * area);
  svg += rectangle(map, -x - field.goalDepth, goal, field.goalDepth, 2 * goal);
  svg += rectangle(map, x, goal, field.goalDepth, 2 * goal);
  svg += fmt::format(
      "<line x1='{0:.1f}' x2='{0:.1f}' y1='{1:.1f}' y2='{2:.1f}'/><circle cx='{0:.1f}' cy='{3:.1f}' "
      "r='{4:.1f}'/></g>\n",
      map.x(0.0), map.y(y), map.y(-y), map.y(0.0), map.scale * field.circleRadius);
  return svg;
}

/// Metres along two edges of the field, and whose goal is where.
std::string scales(const Map& map, const world::FieldGeometry& field) {
  const double x = 0.5 * field.length;
  const double y = 0.5 * field.width;
  std::string svg = "<g fill='#667' font-size='10'>\n";
  for (const double at : roundTicks(-x, x, 6)) {
    svg += fmt::format("<text x='{:.1f}' y='{:.1f}' text-anchor='middle'>{:.0f} m</text>\n", map.x(at),
                       map.y(-y) + 13.0, at);
  }
  for (const double at : roundTicks(-y, y, 4)) {
    svg += fmt::format("<text x='{:.1f}' y='{:.1f}' text-anchor='end'>{:.0f} m</text>\n", map.x(-x) - 3.0,
                       map.y(at) - 3.0, at);
  }
  svg += fmt::format(
      "<text x='{:.1f}' y='{:.1f}'>own goal</text><text x='{:.1f}' y='{:.1f}' text-anchor='end'>goal of the "
      "others</text></g>\n",
      map.x(-x) + 4.0, map.y(0.5 * field.goalWidth) - 3.0, map.x(x) - 4.0,
      map.y(0.5 * field.goalWidth) - 3.0);
  return svg;
}

std::string way(const Map& map, const std::vector<Vector2>& places, const char* color, double width) {
  std::string svg;
  std::string points;
  const auto flush = [&] {
    svg += fmt::format("<polyline fill='none' stroke='{}' stroke-width='{}' points='{}'/>\n", color, width,
                       points);
    points.clear();
  };
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (i > 0 && (places[i] - places[i - 1]).norm() > kJump) flush();
    points += fmt::format("{:.1f},{:.1f} ", map.x(places[i].x()), map.y(places[i].y()));
  }
  flush();
  return svg;
}

std::string dot(const Map& map, const Vector2& place, double radius, const std::string& text, double below) {
  return fmt::format(
      "<circle cx='{0:.1f}' cy='{1:.1f}' r='{2}' fill='white' stroke='{3}'/><text x='{4:.1f}' y='{5:.1f}' "
      "fill='{3}'>{6}</text>\n",
      map.x(place.x()), map.y(place.y()), radius, kTruth, map.x(place.x()) + 6.0,
      map.y(place.y()) - 5.0 + below, text);
}

/// Where the robot was at round times, as far as it has gone on since the last of them.
std::string times(const Map& map, const std::vector<double>& time, const std::vector<Vector2>& truth) {
  constexpr double kApart = 20.0;  // picture units
  std::string svg;
  Vector2 last = truth.front();
  std::size_t i = 0;
  for (const double tick : roundTicks(0.0, time.back(), 15)) {
    while (i + 1 < time.size() && time[i] < tick) ++i;
    if (map.scale * (truth[i] - last).norm() < kApart) continue;
    last = truth[i];
    svg += dot(map, truth[i], 2.5, fmt::format("{:.0f}", tick), 0.0);
  }
  return svg + dot(map, truth.front(), 5.0, "start", 18.0) + dot(map, truth.back(), 3.5, "end", 18.0);
}

Plot errorPlot(const std::string& what, const std::string& unit, const std::vector<double>& time,
               const std::vector<double>& error, double p95) {
  Plot plot;
  plot.title = fmt::format("error of the {} (dotted: 95 % lie below {:.2g} {})", what, p95, unit);
  plot.xLabel = "time since the first message of the map, s";
  plot.yLabel = unit;
  plot.curves = {{"", kBelief, time, error, false, 1.0}};
  plot.limits = {{p95, "", "#c03020"}};
  plot.low = 0.0;
  return plot;
}

std::string plots(const Plot& position, const Plot& heading, double top) {
  const double width = kPictureWidth - kPlotMargin.left - kPlotMargin.right;
  const double second = top + kPlotMargin.top + kPlotHeight + kPlotMargin.bottom;
  return drawPlot(position, {kPlotMargin.left, top + kPlotMargin.top, width, kPlotHeight}) +
         drawPlot(heading, {kPlotMargin.left, second + kPlotMargin.top, width, kPlotHeight});
}

}  // namespace

std::string LocalizationReport::toSvg() const {
  Map map;
  map.corner = {-0.5 * field_.length - kBorder, 0.5 * field_.width + kBorder};
  map.scale = kPictureWidth / (field_.length + 2.0 * kBorder);
  const double bottom = kPictureHead + map.scale * (field_.width + 2.0 * kBorder);
  std::vector<Vector2> truth;
  std::vector<Vector2> believed;
  std::vector<double> time;
  std::vector<double> position;
  std::vector<double> heading;
  for (const Frame& frame : frames_) {
    truth.emplace_back(frame.truth.head<2>());
    believed.emplace_back(frame.believed.head<2>());
    time.push_back(frame.time - frames_.front().time);
    position.push_back(frame.positionError());
    heading.push_back(toDegrees(frame.headingError()));
  }
  const Summary s = summary();
  std::string svg = fmt::format(
      "<text x='14' y='22' font-size='15' font-weight='bold'>Localization over {} vision messages: median "
      "error {:.3f} m, {:.4f} deg</text>\n",
      s.frames, s.position.median, toDegrees(s.heading.median));
  svg += drawLegend({{"truth, with the time in seconds", kTrueWay, false}, {"belief", kBelief, false}}, 14.0,
                    46.0);
  svg += ground(map, field_) + scales(map, field_) + way(map, truth, kTrueWay, 6.0) +
         way(map, believed, kBelief, 1.2);
  if (!frames_.empty()) svg += times(map, time, truth);
  svg += plots(errorPlot("position", "m", time, position, s.position.p95),
               errorPlot("heading", "deg", time, heading, toDegrees(s.heading.p95)), bottom + 6.0);
  return svgPicture(kPictureWidth, bottom + 2.0 * (kPlotHeight + kPlotMargin.top + kPlotMargin.bottom) + 12.0,
                    svg);
}

}  // namespace nonet::lab
