// The field as inline SVG, one metre a unit, seen by a team that plays to the right.
#pragma once

#include <string>
#include <vector>

namespace nonet::lab {

struct FieldSize {
  double length = 30.0;
  double width = 20.0;
  double goalWidth = 2.1;
};

/// A figure with the lines of the field over `below` and below `above`, both in SVG, metres, y downwards.
std::string fieldFigure(const std::string& title, const FieldSize& field, const std::string& below,
                        const std::string& above);

/// How often something was where: one number for each of `columns` x `rows` rectangles of the field, rows
/// from the right touch line (y negative) to the left.
struct HeatMap {
  std::vector<double> counts;
  int columns = 0;
  int rows = 0;
  std::string color;
};

/// The field with its rectangles the darker the more often, and a scale: shares of all counts on a square
/// metre.
std::string heatFigure(const std::string& title, const FieldSize& field, const HeatMap& map);

}  // namespace nonet::lab
