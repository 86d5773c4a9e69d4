// Declared parameters of teams that play worse on purpose, one thing each: sparring partners, and the
// variants that the full team is compared with [MacAlpine 2012a, section 6.3 and table 1]. All off: the full
// team. Files that switch them on lie in params/variants/.
#pragma once

#include "nonet/config/parameters.h"

namespace nonet::team {

struct VariantParameters {
  bool allBall = false;
  bool fixedRoles = false;
  bool defense = false;
  bool boxes = false;
  bool wall = false;
  bool clearFirst = false;
  double clearLength = 12.0;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    using namespace config;
    visit({"allBall", Unit::None, {0, 1}, fixed, "AllBall: everybody but the goalie goes to the ball"},
          self.allBall);
    visit({"fixedRoles",
           Unit::None,
           {0, 1},
           fixed,
           "Static: the nearest plays the ball, everybody else has the role of its number"},
          self.fixedRoles);
    visit({"defense",
           Unit::None,
           {0, 1},
           fixed,
           "Defense: only the one on the ball and the one behind it are not before the own goal"},
          self.defense);
    visit({"boxes",
           Unit::None,
           {0, 1},
           fixed,
           "Boxes: places in nine fixed boxes of the field instead of places about the ball"},
          self.boxes);
    visit({"wall",
           Unit::None,
           {0, 1},
           fixed,
           "Wall: the three nearest at the ball, all others between it and the own goal"},
          self.wall);
    visit({"clearFirst",
           Unit::None,
           {0, 1},
           fixed,
           "In the own half the ball is played away from the own goal, wherever it goes"},
          self.clearFirst);
    visit({"clearLength", Unit::Metre, {1, 30}, fixed, "With clearFirst: how far the ball is played"},
          self.clearLength);
  }
};

}  // namespace nonet::team
