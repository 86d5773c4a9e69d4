// Declared parameters of the technical challenges.
#pragma once

#include "nonet/config/parameters.h"

namespace nonet::team {

struct ChallengeParameters {
  double runAhead = 3.0;
  double runOut = 0.7;
  double blindSpeed = 0.6;
  double kicked = 0.5;
  double near = 0.7;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    using namespace config;
    visit({"runAhead", Unit::Metre, {0.5, 20}, fixed, "Run: how far ahead on its line the robot aims"},
          self.runAhead);
    visit({"runOut", Unit::Metre, {-5, 5}, fixed, "Run: distance from the far goal line at which it stands"},
          self.runOut);
    visit({"blindSpeed",
           Unit::MetrePerSecond,
           {0, 3},
           fixed,
           "Run: speed straight ahead while it does not know where it is"},
          self.blindSpeed);
    visit({"kicked",
           Unit::Metre,
           {0.1, 5},
           fixed,
           "Kick: a ball that is so far from its place has been kicked"},
          self.kicked);
    visit({"near",
           Unit::Metre,
           {0.1, 5},
           fixed,
           "Kick: before the robot has been so near to the ball, the ball is somewhere else because somebody "
           "placed it there"},
          self.near);
  }
};

}  // namespace nonet::team
