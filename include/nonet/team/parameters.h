// Declared parameters of the team stage.
#pragma once

#include "nonet/config/parameters.h"

namespace nonet::team {

struct TeamParameters {
  double nearBall = 0.8;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    using namespace config;
    visit({"nearBall",
           Unit::Metre,
           {0.1, 5.0},
           fixed,
           "Distance to the ball at which careful positioning begins"},
          self.nearBall);
  }
};

}  // namespace nonet::team
