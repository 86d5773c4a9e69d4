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

/// Squares whose darkness is the share of `values`, rows from the right touch line (y negative) to the left.
std::string heatMap(const std::vector<double>& values, int columns, int rows, const FieldSize& field,
                    const std::string& color);

}  // namespace nonet::lab
