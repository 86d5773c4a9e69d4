#include "lab/reports/field_drawing.h"

#include <string>

#include <gtest/gtest.h>

namespace nonet::lab {
namespace {

// Four rectangles of 50 square metres each: a hundred counts, 64 of them in the lower left one.
TEST(HeatFigure, ScaleTellsSharesOfTheTimeOnASquareMetre) {
  const std::string figure =
      heatFigure("Ball", {.length = 20.0, .width = 10.0, .goalWidth = 2.0}, {{64, 36, 0, 0}, 2, 2, "#123"});
  EXPECT_NE(figure.find("1.3 % </small>"), std::string::npos) << "64 / 100 / 50: " << figure;
  EXPECT_NE(figure.find("<rect x='-10.00' y='0.00' width='10.00' height='5.00' opacity='1.00'/>"),
            std::string::npos)
      << "y downwards, the first row lowest";
  EXPECT_NE(figure.find("<rect x='0.00' y='0.00' width='10.00' height='5.00' opacity='0.75'/>"),
            std::string::npos)
      << "the root of 36 / 64";
  EXPECT_EQ(figure.find("opacity='0.00'"), std::string::npos) << "nothing is drawn where nothing was";
}

TEST(HeatFigure, SaysWhereNothingWas) {
  const std::string figure = heatFigure("Ball", {}, {{0, 0}, 2, 1, "#123"});
  EXPECT_NE(figure.find("Ball: never"), std::string::npos);
  EXPECT_EQ(figure.find("opacity"), std::string::npos);
}

}  // namespace
}  // namespace nonet::lab
