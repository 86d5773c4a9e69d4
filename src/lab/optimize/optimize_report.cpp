#include "nonet/lab/optimize/optimize_report.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "nonet/lab/common/atomic_file.h"
#include "nonet/lab/common/statistics.h"
#include "nonet/lab/optimize/optimization_run.h"
#include "nonet/math/angle.h"

#include "lab/common/plot.h"

namespace nonet::lab {

namespace {

using nlohmann::json;

constexpr double kWidth = 760.0;
constexpr double kHeight = 300.0;
constexpr double kSmallWidth = 330.0;
constexpr double kSmallHeight = 170.0;

std::string figure(const Plot& plot, double width, double height, const char* kind) {
  const PlotBox box{kPlotMargin.left, kPlotMargin.top, width - kPlotMargin.left - kPlotMargin.right,
                    height - kPlotMargin.top - kPlotMargin.bottom};
  return fmt::format("<figure class='{}'>{}</figure>\n", kind,
                     svgPicture(width, height, drawPlot(plot, box)));
}

PlotBand around(const std::string& name, const std::string& color, const std::vector<double>& x,
                const std::vector<double>& middle, const std::vector<double>& half) {
  PlotBand band{name, color, {}, {}, {}};
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!std::isfinite(middle[i]) || !std::isfinite(half[i])) continue;
    band.x.push_back(x[i]);
    band.low.push_back(middle[i] - half[i]);
    band.high.push_back(middle[i] + half[i]);
  }
  return band;
}

/// Of the mean of the best candidate's trials; NaN where the file does not hold them. Who lost a race early
/// has fewer trials, over which its mean may be higher by luck.
double bestError(const json& line) {
  const std::size_t trials = std::max<std::size_t>(line.value("seeds", json::array()).size(), 2);
  double best = -std::numeric_limits<double>::infinity();
  double error = std::numeric_limits<double>::quiet_NaN();
  for (const json& candidate : line.value("candidates", json::array())) {
    const auto values = candidate.at("values").get<std::vector<double>>();
    if (values.size() < trials || mean(values) <= best) continue;
    best = mean(values);
    error = standardError(values);
  }
  return error;
}

std::vector<json> readLines(const std::string& path) {
  std::ifstream file(path);
  std::vector<json> lines;
  for (std::string text; std::getline(file, text);) {
    json line = json::parse(text, nullptr, false);
    if (line.is_discarded()) break;  // being written at this moment
    line["bestError"] = bestError(line);
    line.erase("candidates");
    lines.push_back(std::move(line));
  }
  return lines;
}

/// An absent key (of an older run) is a gap as well.
std::vector<double> column(const std::vector<json>& lines, const char* key) {
  std::vector<double> values;
  for (const json& line : lines) {
    const auto value = line.find(key);
    const bool known = value != line.end() && value->is_number();
    values.push_back(known ? value->get<double>() : std::numeric_limits<double>::quiet_NaN());
  }
  return values;
}

/// Where another point became the incumbent.
std::vector<PlotLine> replacements(const std::vector<json>& lines) {
  std::vector<PlotLine> marks;
  std::optional<int> before;
  for (const json& line : lines) {
    if (!line.contains("incumbentGeneration")) continue;
    const int from = line["incumbentGeneration"].get<int>();
    if (before && *before != from) marks.push_back({line.at("generation").get<double>(), "", "#9ab8dd"});
    before = from;
  }
  return marks;
}

std::string fitnessChart(const std::vector<json>& lines) {
  const std::vector<double> generation = column(lines, "generation");
  const std::vector<double> best = column(lines, "best");
  const std::vector<double> incumbent = column(lines, "incumbent");
  Plot plot;
  plot.title = "Fitness";
  plot.xLabel = "generation";
  plot.yLabel = "fitness, higher is better";
  plot.curves = {{"best candidate", "#d07010", generation, best, false},
                 {"mean of the candidates", "#888", generation, column(lines, "mean"), false},
                 {"incumbent", "#2060c0", generation, incumbent, false}};
  plot.bands = {around("", "#d07010", generation, best, column(lines, "bestError")),
                around("", "#2060c0", generation, incumbent, column(lines, "incumbentError"))};
  plot.marks = replacements(lines);
  return figure(plot, kWidth, kHeight, "fitness");
}

std::string fitnessText(const OptimizationSettings& settings, const std::vector<json>& lines) {
  const json& last = lines.back();
  std::string text = fmt::format(
      "<p>Bands: one standard error of the mean over a point's trials. The best of many noisy candidates is\n"
      "partly luck, so its curve lies above what it is worth. The incumbent is the point that would be\n"
      "accepted: every {} generations it meets the centre of the distribution and the best candidate on {}\n"
      "fresh seeds, and gives way to who wins by more than the standard error of the difference (upright\n"
      "lines). Its value is the mean of all its own trials: it moves as trials are added, mostly down at\n"
      "first, since who has just won was lucky too. A run that ends between two such meetings has a\n"
      "last one, which best.toml holds and this page does not",
      settings.validationEvery, settings.validationTrials);
  if (last.contains("incumbentGeneration") && last["incumbent"].is_number()) {
    text += fmt::format("; here it is {:.4g}", last["incumbent"].get<double>());
    if (last.contains("incumbentError") && last["incumbentError"].is_number())
      text += fmt::format(" &plusmn; {:.2g}", last["incumbentError"].get<double>());
    text += fmt::format(" from {} trials, of generation {}", last["incumbentTrials"].get<long>(),
                        last["incumbentGeneration"].get<int>());
  }
  return text + ".</p>\n";
}

std::string stepChart(const std::vector<json>& lines) {
  std::vector<double> sigma = column(lines, "sigma");
  for (double& value : sigma) value = std::log10(value);
  Plot plot;
  plot.title = "Step size sigma, in search ranges";
  plot.xLabel = "generation";
  plot.yLabel = "log10 of sigma";
  plot.curves = {{"sigma", "#2060c0", column(lines, "generation"), sigma, false}};
  return figure(plot, kWidth, 0.7 * kHeight, "sigma");
}

// A small plot of one parameter: the centre of the distribution within one standard deviation, between the
// ends of its search range.
std::string parameterPath(const std::vector<json>& lines, const SearchSpace& space, int i,
                          config::Unit unit) {
  const double scale = unit == config::Unit::Radian ? toDegrees(1.0) : 1.0;
  const std::string unitText(unit == config::Unit::Radian ? "deg" : config::unitName(unit));
  const auto at = static_cast<std::size_t>(i);
  PlotCurve centre{"", "#2060c0", column(lines, "generation"), {}, false};
  PlotBand band{"", "#2060c0", centre.x, {}, {}};
  Plot plot;
  const auto value = [&](double coordinate) { return scale * space.value(i, coordinate); };
  plot.low = value(0.0);
  plot.high = value(1.0);
  for (const json& line : lines) {
    const double middle = line.at("centre").at(at).get<double>();
    const double deviation = line.at("deviations").at(at).get<double>();
    centre.y.push_back(value(middle));
    band.low.push_back(value(middle - deviation));
    band.high.push_back(value(middle + deviation));
    plot.low = std::min(*plot.low, band.low.back());
    plot.high = std::max(*plot.high, band.high.back());
  }
  const double room = 0.06 * (*plot.high - *plot.low);
  *plot.low -= room;
  *plot.high += room;
  plot.title = fmt::format("{:.4g} to {:.4g} {}", centre.y.front(), centre.y.back(), unitText);
  plot.xLabel = "generation";
  plot.yLabel = unitText.empty() ? "value" : unitText;
  plot.limits = {{value(0.0), "", "#888"}, {value(1.0), "", "#888"}};
  for (const double bound : {scale * space.value(i, space.low()[i]), scale * space.value(i, space.high()[i])})
    plot.limits.push_back({bound, "", "#c03020"});
  plot.curves = {std::move(centre)};
  plot.bands = {std::move(band)};
  return fmt::format("<div class='parameter'><b>{}</b>{}</div>\n", xmlText(space.keys()[at]),
                     figure(plot, kSmallWidth, kSmallHeight, "path"));
}

std::string parameterPaths(const std::vector<json>& lines, const SearchSpace& space,
                           const agent::AgentParameters& parameters) {
  std::map<std::string, config::Unit> units;
  for (const config::ParameterView& view : config::listParameters(parameters))
    units[view.key] = view.declaration.unit;
  std::string html =
      "<h2>Parameters</h2>\n<p>The centre of the distribution, and one standard deviation to either side.\n"
      "Grey dots: the search range; red dots: the bounds that hold.</p>\n";
  for (int i = 0; i < space.dimension(); ++i)
    html += parameterPath(lines, space, i, units[space.keys()[static_cast<std::size_t>(i)]]);
  return html;
}

}  // namespace

std::string writeOptimizationReport(const std::string& folder, const std::string& dataFolder) {
  const OptimizationSettings settings = OptimizationRun::readSettings(folder);
  const std::vector<json> lines = readLines(folder + "/generations.jsonl");
  if (lines.empty()) throw std::runtime_error(fmt::format("{}: no generation is finished yet", folder));
  const agent::AgentParameters parameters = settings.startParameters(dataFolder);
  const SearchSpace space(parameters, settings.searchedKeys());
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html><head><meta charset='utf-8'><title>{0}</title><style>"
      "body{{font:14px sans-serif;margin:2em;max-width:1100px}} figure{{margin:0 0 1em}}"
      "div.parameter{{display:inline-block;margin:0 .8em .8em 0;font-size:11px}} p{{max-width:760px}}"
      "</style></head><body>\n<h1>{0}, robot type {1}</h1>\n"
      "<p>{2} of {3} generations, {4} trials, {5} physics, seed {6}, {7} parameters, begun {8}, version "
      "{9}.</p>\n",
      settings.task, settings.robotType, lines.back().at("generation").get<int>(), settings.generations,
      lines.back().at("trials").get<std::int64_t>(), settings.quickSolver ? "quick" : "exact", settings.seed,
      space.dimension(), settings.date, settings.version);
  html += fitnessChart(lines) + fitnessText(settings, lines) + stepChart(lines);
  html += parameterPaths(lines, space, parameters) + "</body></html>\n";
  std::string path = folder + "/report.html";
  writeAtomically(path, html);
  return path;
}

}  // namespace nonet::lab
