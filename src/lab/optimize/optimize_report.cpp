#include "nonet/lab/optimize/optimize_report.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <optional>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "nonet/lab/common/atomic_file.h"
#include "nonet/lab/optimize/optimization_run.h"

namespace nonet::lab {

namespace {

using nlohmann::json;

constexpr double kWidth = 640.0;
constexpr double kHeight = 240.0;
constexpr double kMargin = 46.0;

struct Curve {
  std::string name;
  std::string color;
  std::vector<double> values;  // one per generation; NaN: a gap
};

struct Scale {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void include(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  double y(double value, double height) const {
    const double range = high > low ? high - low : 1.0;
    return height - kMargin / 2 - (value - low) / range * (height - kMargin);
  }
};

std::string polyline(const std::vector<double>& values, const Scale& scale, double width, double height,
                     double left, const std::string& color) {
  std::string lines;
  std::string points;
  const auto flush = [&] {
    if (!points.empty())
      lines +=
          fmt::format("<polyline fill='none' stroke='{}' stroke-width='1.5' points='{}'/>\n", color, points);
    points.clear();
  };
  const double step = (width - left - 6.0) / std::max<double>(1.0, static_cast<double>(values.size()) - 1.0);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) {
      flush();
      continue;
    }
    points += fmt::format("{:.1f},{:.1f} ", left + step * static_cast<double>(i), scale.y(values[i], height));
  }
  flush();
  return lines;
}

std::string chart(const std::string& title, const std::vector<Curve>& curves) {
  Scale scale;
  for (const Curve& curve : curves) {
    for (const double value : curve.values) scale.include(value);
  }
  std::string svg = fmt::format("<figure><figcaption>{}</figcaption><svg viewBox='0 0 {} {}' width='{}'>\n",
                                title, kWidth, kHeight, kWidth);
  for (const double value : {scale.low, 0.5 * (scale.low + scale.high), scale.high}) {
    const double y = scale.y(value, kHeight);
    svg += fmt::format(
        "<line x1='{}' x2='{}' y1='{:.1f}' y2='{:.1f}' stroke='#ddd'/><text x='2' y='{:.1f}'>{:.4g}</text>\n",
        kMargin, kWidth, y, y, y + 4.0, value);
  }
  double legend = kMargin + 8.0;
  for (const Curve& curve : curves) {
    svg += polyline(curve.values, scale, kWidth, kHeight, kMargin, curve.color);
    svg += fmt::format("<text x='{}' y='12' fill='{}'>{}</text>\n", legend, curve.color, curve.name);
    legend += 12.0 + 7.0 * static_cast<double>(curve.name.size());
  }
  return svg + "</svg></figure>\n";
}

// A small plot of one parameter: the centre of the distribution within one standard deviation.
std::string parameterPath(const std::string& key, const std::vector<double>& centre,
                          const std::vector<double>& low, const std::vector<double>& high) {
  constexpr double kSmallWidth = 210.0;
  constexpr double kSmallHeight = 90.0;
  Scale scale;
  for (const auto* values : {&centre, &low, &high}) {
    for (const double value : *values) scale.include(value);
  }
  std::string svg = fmt::format(
      "<figure class='small'><figcaption>{}: {:.4g} &rarr; {:.4g}</figcaption>"
      "<svg viewBox='0 0 {} {}' width='{}'>\n",
      key, centre.front(), centre.back(), kSmallWidth, kSmallHeight, kSmallWidth);
  for (const auto* values : {&low, &high})
    svg += polyline(*values, scale, kSmallWidth, kSmallHeight, 2.0, "#bbb");
  svg += polyline(centre, scale, kSmallWidth, kSmallHeight, 2.0, "#06c");
  return svg + "</svg></figure>\n";
}

std::vector<json> readLines(const std::string& path) {
  std::ifstream file(path);
  std::vector<json> lines;
  for (std::string text; std::getline(file, text);) {
    json line = json::parse(text, nullptr, false);
    if (line.is_discarded()) break;  // being written at this moment
    line.erase("candidates");
    lines.push_back(std::move(line));
  }
  return lines;
}

std::vector<double> column(const std::vector<json>& lines, const char* key) {
  std::vector<double> values;
  for (const json& line : lines) {
    const json& value = line.at(key);
    values.push_back(value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN());
  }
  return values;
}

std::string parameterPaths(const std::vector<json>& lines, const SearchSpace& space) {
  std::string html;
  for (int i = 0; i < space.dimension(); ++i) {
    std::vector<double> centre;
    std::vector<double> low;
    std::vector<double> high;
    for (const json& line : lines) {
      const double at = line.at("centre").at(static_cast<std::size_t>(i)).get<double>();
      const double deviation = line.at("deviations").at(static_cast<std::size_t>(i)).get<double>();
      centre.push_back(space.value(i, at));
      low.push_back(space.value(i, at - deviation));
      high.push_back(space.value(i, at + deviation));
    }
    html += parameterPath(space.keys()[static_cast<std::size_t>(i)], centre, low, high);
  }
  return html;
}

}  // namespace

std::string writeOptimizationReport(const std::string& folder, const std::string& dataFolder) {
  std::ifstream configFile(folder + "/config.json");
  if (!configFile) throw std::runtime_error(fmt::format("{} is not the folder of a run", folder));
  const auto config = OptimizationConfig::fromJson(json::parse(configFile));
  const std::vector<json> lines = readLines(folder + "/generations.jsonl");
  if (lines.empty()) throw std::runtime_error(fmt::format("{}: no generation is finished yet", folder));
  const SearchSpace space(config.startParameters(dataFolder), config.searchedKeys());

  std::vector<double> sigma = column(lines, "sigma");
  for (double& value : sigma) value = std::log10(value);
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html><head><meta charset='utf-8'><title>{0}</title><style>"
      "body{{font:14px sans-serif;margin:2em;max-width:1100px}} text{{font:11px sans-serif}}"
      "figure{{margin:0 0 1.5em}} figure.small{{display:inline-block;margin:0 .8em .8em 0;font-size:11px}}"
      "</style></head><body>\n<h1>{0}, robot type {1}</h1>\n"
      "<p>{2} of {3} generations, {4} trials, {5} physics, seed {6}, {7} parameters, begun {8}, version "
      "{9}.</p>\n",
      config.task, config.robotType, lines.back().at("generation").get<int>(), config.generations,
      lines.back().at("trials").get<std::int64_t>(), config.quickSolver ? "quick" : "exact", config.seed,
      space.dimension(), config.date, config.version);
  html += chart("Fitness by generation", {{"best candidate", "#c60", column(lines, "best")},
                                          {"mean of the candidates", "#888", column(lines, "mean")},
                                          {"incumbent, validated", "#06c", column(lines, "incumbent")}});
  html += chart("Step size, powers of ten", {{"sigma", "#06c", sigma}});
  html += "<h2>Parameters: centre of the distribution, within one standard deviation</h2>\n";
  html += parameterPaths(lines, space) + "</body></html>\n";
  std::string path = folder + "/report.html";
  writeAtomically(path, html);
  return path;
}

}  // namespace nonet::lab
