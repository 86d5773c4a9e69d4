// Declared parameters of the world stage.
#pragma once

#include "nonet/config/parameters.h"

namespace nonet::world {

struct WorldParameters {
  double fallenAngle = 0.9;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    using namespace config;
    visit({"fallenAngle",
           Unit::Radian,
           {0.3, 1.5},
           fixed,
           "Tilt of the torso beyond which the robot counts as fallen"},
          self.fallenAngle);
  }
};

}  // namespace nonet::world
