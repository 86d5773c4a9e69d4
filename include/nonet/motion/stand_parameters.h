// Declared parameters of standing.
#pragma once

#include "nonet/config/parameters.h"

namespace nonet::motion {

struct StandParameters {
  double height = 0.88;
  double xOffset = -0.005;
  double ySep = 0.11;
  double armPitch = -1.57;
  double armYaw = 0.15;
  double elbow = 0.2;
  double blendTime = 0.6;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    using namespace config;
    visit({"height", Unit::None, {0.5, 1.0}, fixed, "Torso height as a share of that with straight legs"},
          self.height);
    visit({"xOffset", Unit::Metre, {-0.1, 0.1}, fixed, "Feet ahead of the torso"}, self.xOffset);
    visit({"ySep", Unit::Metre, {0.0, 0.3}, fixed, "Separation of the feet"}, self.ySep);
    visit({"armPitch", Unit::Radian, {-2.0, 2.0}, fixed, "Shoulder pitch, 0 = forward"}, self.armPitch);
    visit({"armYaw", Unit::Radian, {0.0, 1.6}, fixed, "Arms outwards"}, self.armYaw);
    visit({"elbow", Unit::Radian, {0.0, 1.5}, fixed, "Elbows bent"}, self.elbow);
    visit({"blendTime", Unit::Second, {0.02, 5.0}, fixed, "Time to take the stand from another pose"},
          self.blendTime);
  }
};

}  // namespace nonet::motion
