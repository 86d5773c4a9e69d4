// Declared parameters of the world stage.
#pragma once

#include "nonet/config/parameters.h"

namespace nonet::world {

struct WorldParameters {
  double fallenAngle = 0.9;
  double fallingAngle = 0.75;
  double uprightAngle = 0.45;
  double fallPreview = 0.05;
  double longestLean = 2.0;
  // For measurements of what each part is worth.
  bool useParticleFilter = true;
  bool usePoseFit = true;
  bool useLines = true;

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
    visit({"fallPreview", Unit::Second, {0.0, 1.0}, fixed, "Preview of the tilt for falling"},
          self.fallPreview);
    visit({"longestLean",
           Unit::Second,
           {0.1, 20.0},
           fixed,
           "A robot that has been falling for longer leans on something: it counts as fallen"},
          self.longestLean);
    visit(
        {"useParticleFilter",
         Unit::None,
         {0, 1},
         fixed,
         "Localization by the particle filter; without it by the fit alone, started from landmark geometry"},
        self.useParticleFilter);
    visit({"usePoseFit",
           Unit::None,
           {0, 1},
           fixed,
           "Localization by the least-squares fit; without it by the particle filter alone"},
          self.usePoseFit);
    visit({"useLines", Unit::None, {0, 1}, fixed, "Localization by field lines as well as by landmarks"},
          self.useLines);
  }
};

}  // namespace nonet::world
