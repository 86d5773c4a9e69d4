// Plots as SVG: title, axes with units and ticks, legend, limits. Every picture of the laboratory that has a
// time, a generation or metres along its bottom is made of these.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nonet::lab {

// Of a picture with several plots: its width and the room above them for a title; m around what is drawn.
constexpr double kPictureWidth = 1000.0;
constexpr double kPictureHead = 60.0;
constexpr double kPlotRoom = 0.5;

struct PlotCurve {
  std::string name;  // in the legend, once for all of this name; empty: not there
  std::string color;
  std::vector<double> x;
  std::vector<double> y;  // as many; NaN: a gap
  bool dashed = false;
  double width = 1.4;
  double opacity = 1.0;
};

/// Single places.
struct PlotDots {
  std::string name;
  std::string color;
  std::vector<double> x;
  std::vector<double> y;
  double radius = 3.0;  // picture units
};

/// The area between two curves.
struct PlotBand {
  std::string name;
  std::string color;
  std::vector<double> x;
  std::vector<double> low;
  std::vector<double> high;
};

/// A straight line across the plot, with a word beside it if there is room.
struct PlotLine {
  double at = 0.0;
  std::string text;
  std::string color;
};

struct Plot {
  std::string title;
  std::string xLabel;  // with the unit: "time, s"
  std::string yLabel;
  std::vector<PlotBand> bands;
  std::vector<PlotCurve> curves;
  std::vector<PlotDots> dots;
  std::vector<PlotLine> marks;   // upright, at places of x
  std::vector<PlotLine> limits;  // level, at values of y; those out of the picture are left out
  std::optional<double> left;    // of the x axis; otherwise the data decide
  std::optional<double> right;
  std::optional<double> low;  // of the y axis, likewise
  std::optional<double> high;
  std::vector<double> yTicks;  // empty: round numbers
  bool legend = true;
};

/// The frame that the axes make, in picture coordinates. Around it kPlotMargin of room is needed for what is
/// written there.
struct PlotBox {
  double left = 0.0;
  double top = 0.0;
  double width = 0.0;
  double height = 0.0;
};
struct PlotMargin {
  double left = 62.0;
  double top = 24.0;
  double right = 12.0;
  double bottom = 38.0;
};
inline constexpr PlotMargin kPlotMargin;

/// The plot as SVG elements, in a group of class "plot".
std::string drawPlot(const Plot& plot, const PlotBox& box);

/// A frame of this width in which a metre is as long upwards as along the bottom.
PlotBox trueToScale(const Plot& plot, double left, double top, double width);

struct LegendEntry {
  std::string name;
  std::string color;
  bool dashed = false;
  double dot = 0.0;  // radius of a dot; 0: a line
};
/// What drawPlot() writes beside the title, for pictures that have one legend for several plots.
std::vector<LegendEntry> legendOf(const Plot& plot);
/// A line of entries that begins at (x, y).
std::string drawLegend(const std::vector<LegendEntry>& entries, double x, double y);

/// A whole picture; `xmlns` and white ground included.
std::string svgPicture(double width, double height, std::string_view content);

/// Round numbers that divide low..high into about `count` parts.
std::vector<double> roundTicks(double low, double high, int count);
/// With as many digits as those numbers need.
std::string tickText(double value, const std::vector<double>& ticks);

/// Text for an element: & < > ' escaped.
std::string xmlText(std::string_view text);

}  // namespace nonet::lab
