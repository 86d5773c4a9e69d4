#include "lab/reports/field_drawing.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

namespace nonet::lab {
namespace {

// Opacity of a rectangle, by its share of the darkest one's count: the root keeps seldom visited places
// visible.
double darkness(double share) {
  return std::sqrt(share);
}

}  // namespace

std::string fieldFigure(const std::string& title, const FieldSize& field, const std::string& below,
                        const std::string& above) {
  const double x = field.length / 2.0;
  const double y = field.width / 2.0;
  std::string svg = fmt::format(
      "<figure><figcaption>{}</figcaption><svg class='field' viewBox='{} {} {} {}' width='460'>\n"
      "<rect x='{}' y='{}' width='{}' height='{}' fill='#f3f7f1'/>\n{}",
      title, -x - 1.0, -y - 0.5, field.length + 2.0, field.width + 1.0, -x, -y, field.length, field.width,
      below);
  svg += fmt::format(
      "<g fill='none' stroke='#555' stroke-width='0.08'><rect x='{0}' y='{1}' width='{2}' height='{3}'/>"
      "<line x1='0' x2='0' y1='{1}' y2='{4}'/><circle r='2'/>",
      -x, -y, field.length, field.width, y);
  for (const double side : {-1.0, 1.0}) {
    svg += fmt::format("<rect x='{}' y='{}' width='0.6' height='{}' stroke='#06c'/>",
                       side > 0.0 ? x : -x - 0.6, -field.goalWidth / 2.0, field.goalWidth);
  }
  return svg + "</g>\n" + above + "</svg></figure>\n";
}

std::string heatFigure(const std::string& title, const FieldSize& field, const HeatMap& map) {
  const double most = map.counts.empty() ? 0.0 : *std::max_element(map.counts.begin(), map.counts.end());
  if (most <= 0.0) return fieldFigure(title + ": never", field, "", "");
  const double width = field.length / map.columns;
  const double height = field.width / map.rows;
  std::string svg = fmt::format("<g fill='{}'>", map.color);
  for (int row = 0; row < map.rows; ++row) {
    for (int column = 0; column < map.columns; ++column) {
      const auto place = static_cast<std::size_t>(row) * static_cast<std::size_t>(map.columns) +
                         static_cast<std::size_t>(column);
      const double opacity = darkness(map.counts[place] / most);
      if (opacity < 0.02) continue;
      svg += fmt::format("<rect x='{:.2f}' y='{:.2f}' width='{:.2f}' height='{:.2f}' opacity='{:.2f}'/>",
                         column * width - field.length / 2.0, field.width / 2.0 - (row + 1) * height, width,
                         height, opacity);
    }
  }
  const double all = std::accumulate(map.counts.begin(), map.counts.end(), 0.0);
  std::string scale = "<br><small>of the time, on a square metre: ";
  for (const double share : {0.04, 0.16, 0.36, 0.64, 1.0}) {
    scale += fmt::format(
        "<span style='display:inline-block;width:1.2em;height:0.8em;background:{};opacity:{:.2f}'></span> "
        "{:.2g} % ",
        map.color, darkness(share), 100.0 * share * most / all / (width * height));
  }
  return fieldFigure(title + scale + "</small>", field, svg + "</g>\n", "");
}

}  // namespace nonet::lab
