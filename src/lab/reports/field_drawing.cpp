#include "lab/reports/field_drawing.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace nonet::lab {

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

std::string heatMap(const std::vector<double>& values, int columns, int rows, const FieldSize& field,
                    const std::string& color) {
  const double most = values.empty() ? 0.0 : *std::max_element(values.begin(), values.end());
  if (most <= 0.0) return "";
  const double width = field.length / columns;
  const double height = field.width / rows;
  std::string svg = fmt::format("<g fill='{}'>", color);
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      // The root keeps seldom visited places visible.
      const int place = row * columns + column;
      const double share = std::sqrt(values[static_cast<std::size_t>(place)] / most);
      if (share < 0.02) continue;
      svg += fmt::format("<rect x='{:.2f}' y='{:.2f}' width='{:.2f}' height='{:.2f}' opacity='{:.2f}'/>",
                         column * width - field.length / 2.0, field.width / 2.0 - (row + 1) * height, width,
                         height, share);
    }
  }
  return svg + "</g>\n";
}

}  // namespace nonet::lab
