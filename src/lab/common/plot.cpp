#include "lab/common/plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace nonet::lab {

namespace {

constexpr double kTickLength = 4.0;
constexpr double kTickSpace = 48.0;  // picture units from one tick of the x axis to the next, at least
constexpr double kLineHeight = 22.0;
constexpr double kLetter = 6.3;  // mean width of one

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void include(const std::vector<double>& values) {
    for (const double value : values) {
      if (!std::isfinite(value)) continue;
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  // So that there is something to divide by, and curves do not touch the frame.
  void widen(double share) {
    if (!(low <= high)) *this = {0.0, 1.0};
    double room = share * (high - low);
    if (high - low < 1e-9 * std::max(1.0, std::abs(high))) room = std::max(1e-6, 0.05 * std::abs(high));
    low -= room;
    high += room;
  }
};

// From values to picture coordinates.
struct Axes {
  Range x;
  Range y;
  PlotBox box;

  double atX(double value) const { return box.left + box.width * (value - x.low) / (x.high - x.low); }
  double atY(double value) const { return box.top + box.height * (y.high - value) / (y.high - y.low); }
};

Axes axesOf(const Plot& plot, const PlotBox& box) {
  Axes axes;
  axes.box = box;
  for (const PlotBand& band : plot.bands) {
    axes.x.include(band.x);
    axes.y.include(band.low);
    axes.y.include(band.high);
  }
  for (const PlotCurve& curve : plot.curves) {
    axes.x.include(curve.x);
    axes.y.include(curve.y);
  }
  for (const PlotDots& dots : plot.dots) {
    axes.x.include(dots.x);
    axes.y.include(dots.y);
  }
  axes.x.widen(0.0);
  axes.y.widen(0.06);
  axes.x.low = plot.left.value_or(axes.x.low);
  axes.x.high = plot.right.value_or(axes.x.high);
  axes.y.low = plot.low.value_or(axes.y.low);
  axes.y.high = plot.high.value_or(axes.y.high);
  return axes;
}

std::string frame(const Plot& plot, const Axes& axes) {
  const PlotBox& box = axes.box;
  std::string svg;
  const std::vector<double> levels =
      !plot.yTicks.empty() ? plot.yTicks
                           : roundTicks(axes.y.low, axes.y.high, static_cast<int>(box.height / kLineHeight));
  for (const double level : levels) {
    svg += fmt::format(
        "<line x1='{0:.1f}' x2='{1:.1f}' y1='{2:.1f}' y2='{2:.1f}' stroke='#e4e4e4'/>"
        "<text x='{3:.1f}' y='{4:.1f}' text-anchor='end'>{5}</text>\n",
        box.left, box.left + box.width, axes.atY(level), box.left - 5.0, axes.atY(level) + 4.0,
        tickText(level, levels));
  }
  const double bottom = box.top + box.height;
  const std::vector<double> places =
      roundTicks(axes.x.low, axes.x.high, std::max(2, static_cast<int>(box.width / kTickSpace)));
  for (const double place : places) {
    svg += fmt::format(
        "<line class='tick' x1='{0:.1f}' x2='{0:.1f}' y1='{1:.1f}' y2='{2:.1f}' stroke='#666'/>"
        "<text x='{0:.1f}' y='{3:.1f}' text-anchor='middle'>{4}</text>\n",
        axes.atX(place), bottom, bottom + kTickLength, bottom + 16.0, tickText(place, places));
  }
  svg +=
      fmt::format("<rect x='{:.1f}' y='{:.1f}' width='{:.1f}' height='{:.1f}' fill='none' stroke='#999'/>\n",
                  box.left, box.top, box.width, box.height);
  return svg;
}

std::string labels(const Plot& plot, const PlotBox& box) {
  std::string svg = fmt::format("<text class='title' x='{:.1f}' y='{:.1f}' font-weight='bold'>{}</text>\n",
                                box.left, box.top - 7.0, xmlText(plot.title));
  svg += fmt::format("<text class='axis' x='{:.1f}' y='{:.1f}' text-anchor='middle'>{}</text>\n",
                     box.left + 0.5 * box.width, box.top + box.height + 31.0, xmlText(plot.xLabel));
  const double x = box.left - 48.0;
  const double y = box.top + 0.5 * box.height;
  svg += fmt::format(
      "<text class='axis' x='{0:.1f}' y='{1:.1f}' text-anchor='middle' transform='rotate(-90 {0:.1f} "
      "{1:.1f})'>{2}</text>\n",
      x, y, xmlText(plot.yLabel));
  return svg;
}

std::string bandOf(const PlotBand& band, const Axes& axes) {
  std::string points;
  for (std::size_t i = 0; i < band.x.size(); ++i)
    points += fmt::format("{:.1f},{:.1f} ", axes.atX(band.x[i]), axes.atY(band.high[i]));
  for (std::size_t i = band.x.size(); i-- > 0;)
    points += fmt::format("{:.1f},{:.1f} ", axes.atX(band.x[i]), axes.atY(band.low[i]));
  return fmt::format("<polygon fill='{}' fill-opacity='0.18' points='{}'/>\n", band.color, points);
}

std::string opacityOf(const PlotCurve& curve) {
  return curve.opacity < 1.0 ? fmt::format(" stroke-opacity='{:.2g}'", curve.opacity) : "";
}

std::string curveOf(const PlotCurve& curve, const Axes& axes) {
  std::string svg;
  std::string points;
  const auto flush = [&] {
    if (!points.empty()) {
      svg +=
          fmt::format("<polyline fill='none' stroke='{}' stroke-width='{}'{}{} points='{}'/>\n", curve.color,
                      curve.width, curve.dashed ? " stroke-dasharray='5 3'" : "", opacityOf(curve), points);
    }
    points.clear();
  };
  for (std::size_t i = 0; i < curve.y.size(); ++i) {
    if (std::isfinite(curve.y[i])) {
      points += fmt::format("{:.1f},{:.1f} ", axes.atX(curve.x[i]), axes.atY(curve.y[i]));
    } else {
      flush();
    }
  }
  flush();
  return svg;
}

std::string dotsOf(const PlotDots& dots, const Axes& axes) {
  std::string svg = fmt::format("<g fill='{}' fill-opacity='0.7'>", dots.color);
  for (std::size_t i = 0; i < dots.x.size(); ++i) {
    svg += fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='{:.1f}'/>", axes.atX(dots.x[i]),
                       axes.atY(dots.y[i]), dots.radius);
  }
  return svg + "</g>\n";
}

std::string limitLines(const Plot& plot, const Axes& axes) {
  const PlotBox& box = axes.box;
  std::string svg;
  for (const PlotLine& limit : plot.limits) {
    if (limit.at < axes.y.low || limit.at > axes.y.high) continue;
    const double y = axes.atY(limit.at);
    svg += fmt::format(
        "<line class='limit' x1='{0:.1f}' x2='{1:.1f}' y1='{2:.1f}' y2='{2:.1f}' stroke='{3}' "
        "stroke-dasharray='2 3'/><text x='{4:.1f}' y='{5:.1f}' text-anchor='end' fill='{3}'>{6}</text>\n",
        box.left, box.left + box.width, y, limit.color, box.left + box.width - 3.0,
        y > box.top + 14.0 ? y - 3.0 : y + 12.0, xmlText(limit.text));
  }
  return svg;
}

// The words of marks that stand close together go below each other.
std::string markLines(const Plot& plot, const Axes& axes) {
  constexpr double kSmall = 9.0;
  const PlotBox& box = axes.box;
  std::array<double, 4> taken;  // per row: up to where
  taken.fill(box.left - 1.0);
  std::string svg;
  for (const PlotLine& mark : plot.marks) {
    if (mark.at < axes.x.low || mark.at > axes.x.high) continue;
    const double x = axes.atX(mark.at);
    svg +=
        fmt::format("<line class='mark' x1='{0:.1f}' x2='{0:.1f}' y1='{1:.1f}' y2='{2:.1f}' stroke='{3}'/>\n",
                    x, box.top, box.top + box.height, mark.color);
    const auto row = std::find_if(taken.begin(), taken.end(), [x](double end) { return end < x; });
    if (row == taken.end() || mark.text.empty()) continue;
    *row = x + 3.0 + kSmall / 11.0 * kLetter * static_cast<double>(mark.text.size());
    svg += fmt::format("<text x='{:.1f}' y='{:.1f}' fill='{}' font-size='{}'>{}</text>\n", x + 2.0,
                       box.top + kSmall * static_cast<double>(row - taken.begin() + 1), mark.color, kSmall,
                       xmlText(mark.text));
  }
  return svg;
}

double widthOf(const LegendEntry& entry) {
  return 36.0 + kLetter * static_cast<double>(entry.name.size());
}

}  // namespace

std::string drawPlot(const Plot& plot, const PlotBox& box) {
  const Axes axes = axesOf(plot, box);
  std::string svg = "<g class='plot'>\n" + frame(plot, axes) + labels(plot, box);
  for (const PlotBand& band : plot.bands) svg += bandOf(band, axes);
  svg += limitLines(plot, axes) + markLines(plot, axes);
  for (const PlotCurve& curve : plot.curves) svg += curveOf(curve, axes);
  for (const PlotDots& dots : plot.dots) svg += dotsOf(dots, axes);
  const std::vector<LegendEntry> entries = plot.legend ? legendOf(plot) : std::vector<LegendEntry>();
  double width = 0.0;
  for (const LegendEntry& entry : entries) width += widthOf(entry);
  svg += drawLegend(entries, box.left + box.width - width, box.top - 7.0);
  return svg + "</g>\n";
}

PlotBox trueToScale(const Plot& plot, double left, double top, double width) {
  const Axes axes = axesOf(plot, {});
  return {left, top, width, width * (axes.y.high - axes.y.low) / (axes.x.high - axes.x.low)};
}

std::vector<LegendEntry> legendOf(const Plot& plot) {
  std::vector<LegendEntry> entries;
  const auto add = [&entries](const LegendEntry& entry) {
    const bool known = std::any_of(entries.begin(), entries.end(),
                                   [&entry](const LegendEntry& other) { return other.name == entry.name; });
    if (!entry.name.empty() && !known) entries.push_back(entry);
  };
  for (const PlotCurve& curve : plot.curves) add({curve.name, curve.color, curve.dashed});
  for (const PlotBand& band : plot.bands) add({band.name, band.color});
  for (const PlotDots& dots : plot.dots) add({dots.name, dots.color, false, dots.radius});
  return entries;
}

std::string drawLegend(const std::vector<LegendEntry>& entries, double x, double y) {
  if (entries.empty()) return "";
  std::string svg = "<g class='legend'>";
  for (const LegendEntry& entry : entries) {
    const std::string sign =
        entry.dot > 0.0
            ? fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='{:.1f}' fill='{}'/>", x + 9.0, y - 4.0,
                          entry.dot, entry.color)
            : fmt::format(
                  "<line x1='{:.1f}' x2='{:.1f}' y1='{:.1f}' y2='{:.1f}' stroke='{}' "
                  "stroke-width='2.5'{}/>",
                  x, x + 18.0, y - 4.0, y - 4.0, entry.color, entry.dashed ? " stroke-dasharray='5 3'" : "");
    svg += fmt::format("{}<text x='{:.1f}' y='{:.1f}'>{}</text>\n", sign, x + 22.0, y, xmlText(entry.name));
    x += widthOf(entry);
  }
  return svg + "</g>\n";
}

std::string svgPicture(double width, double height, std::string_view content) {
  return fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' width='{0:.0f}' height='{1:.0f}' viewBox='0 0 {0:.0f} "
      "{1:.0f}' font-family='sans-serif' font-size='11'>\n<rect width='100%' height='100%' "
      "fill='white'/>\n{2}</svg>\n",
      width, height, content);
}

std::vector<double> roundTicks(double low, double high, int count) {
  const double wanted = (high - low) / std::max(1, count);
  const double decade = std::pow(10.0, std::floor(std::log10(wanted)));
  double step = 10.0 * decade;
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * decade >= wanted * (1.0 - 1e-9)) {
      step = factor * decade;
      break;
    }
  }
  std::vector<double> ticks;
  // From whole numbers, so that no tick is 1e-17 instead of 0.
  const auto first = static_cast<long>(std::ceil(low / step - 1e-9));
  const auto last = static_cast<long>(std::floor(high / step + 1e-9));
  for (long k = first; k <= last; ++k) ticks.push_back(static_cast<double>(k) * step);
  return ticks;
}

std::string tickText(double value, const std::vector<double>& ticks) {
  const double step = ticks.size() > 1 ? std::abs(ticks[1] - ticks[0]) : std::abs(value);
  if (step <= 0.0 || std::abs(value) >= 1e5 || step < 1e-5) return fmt::format("{:.3g}", value);
  const int digits = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 5);
  return fmt::format("{:.{}f}", value, digits);
}

std::string xmlText(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '\'':
        out += "&apos;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

}  // namespace nonet::lab
