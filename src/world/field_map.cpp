#include "nonet/world/field_map.h"

#include <cmath>

namespace nonet::world {

FieldGeometry largeField() {
  return {};
}

FieldGeometry smallField() {
  FieldGeometry geometry;
  geometry.length = 21.0;
  geometry.width = 14.0;
  return geometry;
}

FieldMap::FieldMap(const FieldGeometry& geometry) : geometry_(geometry) {
  using protocol::Landmark;
  const double x = 0.5 * geometry.length;
  const double y = 0.5 * geometry.width;
  const double post = 0.5 * geometry.goalWidth;
  const auto place = [&](Landmark id, double px, double py, double pz) {
    landmarks_[static_cast<std::size_t>(id)] = {px, py, pz};
  };
  place(Landmark::F1L, -x, y, 0.0);
  place(Landmark::F2L, -x, -y, 0.0);
  place(Landmark::F1R, x, y, 0.0);
  place(Landmark::F2R, x, -y, 0.0);
  place(Landmark::G1L, -x, post, geometry.goalHeight);
  place(Landmark::G2L, -x, -post, geometry.goalHeight);
  place(Landmark::G1R, x, post, geometry.goalHeight);
  place(Landmark::G2R, x, -post, geometry.goalHeight);

  std::size_t count = 0;
  const auto draw = [&](double x1, double y1, double x2, double y2) {
    FieldLine& line = lines_[count++];
    line.begin = {x1, y1, 0.0};
    line.end = {x2, y2, 0.0};
    line.length = (line.end - line.begin).norm();
    line.direction = (line.end - line.begin) / line.length;
  };
  const double front = x - geometry.areaLength;
  const double side = 0.5 * geometry.areaWidth;
  draw(0, -y, 0, y);
  draw(x, -y, x, y);
  draw(-x, -y, -x, y);
  draw(x, y, -x, y);
  draw(x, -y, -x, -y);
  draw(front, side, front, -side);
  draw(front, side, x, side);
  draw(front, -side, x, -side);
  draw(-front, side, -front, -side);
  draw(-front, side, -x, side);
  draw(-front, -side, -x, -side);
  for (int k = 0; k < 10; ++k) {
    const double from = k * kPi / 5.0;
    const double to = (k + 1) * kPi / 5.0;
    const double r = geometry.circleRadius;
    draw(r * std::cos(from), r * std::sin(from), r * std::cos(to), r * std::sin(to));
  }
}

}  // namespace nonet::world
