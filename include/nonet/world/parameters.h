// Declared parameters of the world stage.
#pragma once

#include "nonet/config/parameters.h"

namespace nonet::world {

struct WorldParameters {
  double fallenAngle = 0.9;
  double fallingAngle = 0.62;
  double uprightAngle = 0.45;
  double fallPreview = 0.19;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    using namespace config;
    visit({"fallenAngle",
           Unit::Radian,
           {0.3, 1.5},
           fixed,
           "Tilt of the torso beyond which the robot counts as fallen"},
          self.fallenAngle);
    visit({"fallingAngle",
           Unit::Radian,
           {0.2, 1.5},
           fixed,
           "Previewed tilt (tilt plus rate times fallPreview) beyond which the robot counts as falling"},
          self.fallingAngle);
    visit({"uprightAngle",
           Unit::Radian,
           {0.1, 1.2},
           fixed,
           "Tilt below which a fallen or falling robot counts as upright again"},
          self.uprightAngle);
    visit({"fallPreview",
           Unit::Second,
           {0.0, 1.0},
           fixed,
           "Preview of the tilt for falling: about sqrt(height of the centre of mass / gravity)"},
          self.fallPreview);
  }
};

}  // namespace nonet::world
