// Declared parameters of pass mode: when the referee is asked for it (pass_mode.h).
#pragma once

#include "nonet/config/parameters.h"

namespace nonet::team {

struct PassModeParameters {
  bool use = false;
  double rolling = 0.3;
  double room = 0.95;
  double disturbed = 3.0;
  double clear = 1.15;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    using namespace config;
    visit({"use", Unit::None, {}, fixed, "Whether the referee is asked for pass mode"}, self.use);
    visit({"rolling",
           Unit::MetrePerSecond,
           {0, 1},
           fixed,
           "Not for a ball that seems to roll faster; the referee says 0.05 m/s and measures better"},
          self.rolling);
    visit({"room",
           Unit::Metre,
           {0, 3},
           fixed,
           "Nor while an opponent seems nearer to the ball; the referee says 1 m"},
          self.room);
    visit({"disturbed",
           Unit::Metre,
           {0, 30},
           search(1.5, 6),
           "Nor when none is within this distance, who could disturb"},
          self.disturbed);
    visit({"clear", Unit::Metre, {0, 5}, fixed, "Distance from the ball in the opponents' pass mode"},
          self.clear);
  }
};

}  // namespace nonet::team
