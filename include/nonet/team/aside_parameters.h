// Declared parameters of kicks to the side, past an opponent at the ball (behaviors/kick_aside.cpp).
#pragma once

#include "nonet/config/parameters.h"

namespace nonet::team {

struct AsideParameters {
  bool use = false;  // not proven: docs/history.md
  double opponent = 1.2;
  double barred = 0.3;
  double fromGoal = 10.0;
  double near = 0.35;
  double rolling = 0.4;
  double lane = 0.14;
  double laneGrowth = 0.12;
  double length = 0.75;
  double margin = 0.5;
  double turnCost = 0.6;
  double wayCost = 2.0;
  double keep = 0.2;
  double least = 0.2;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    using namespace config;
    visit({"use", Unit::None, {0, 1}, fixed, "Whether the ball is kicked to the side past an opponent at it"},
          self.use);
    visit({"opponent",
           Unit::Metre,
           {0, 5},
           search(0.4, 2),
           "Only while the nearest opponent is not farther from the ball"},
          self.opponent);
    visit({"barred",
           Unit::None,
           {0, 1},
           search(0, 1),
           "Only while opponents near the ball bar its way to the goal by at least so much"},
          self.barred);
    visit({"fromGoal",
           Unit::Metre,
           {0, 50},
           search(2, 15),
           "Only while the ball is not nearer to the opponent's goal: there pushes score"},
          self.fromGoal);
    visit({"near",
           Unit::Metre,
           {0.1, 2},
           search(0.25, 0.6),
           "Only by a robot that is not farther from the ball"},
          self.near);
    visit({"rolling", Unit::MetrePerSecond, {0, 5}, fixed, "Not while the ball rolls faster"}, self.rolling);
    visit({"lane",
           Unit::Metre,
           {0, 2},
           search(0.1, 0.3),
           "No opponent may stand nearer to the ball's way, at its begin"},
          self.lane);
    visit({"laneGrowth", Unit::None, {0, 1}, fixed, "How much wider the free way must be per metre of it"},
          self.laneGrowth);
    visit({"length",
           Unit::None,
           {0.1, 1},
           fixed,
           "Length of such a kick as a share of the longest that its head declares: the opponent is in its "
           "way"},
          self.length);
    visit({"margin",
           Unit::Metre,
           {0, 5},
           fixed,
           "A kick past an opponent comes to rest at least this far within the field"},
          self.margin);
    visit({"turnCost",
           Unit::None,
           {0, 5},
           search(0.2, 2),
           "Cost of turning by a radian before the kick; the way straight to the ball's target is worth 1"},
          self.turnCost);
    visit({"wayCost", Unit::Hertz, {0, 20}, search(0.5, 5), "Cost of a metre to the place for the kick"},
          self.wayCost);
    visit({"keep", Unit::None, {0, 2}, fixed, "Worth more of the direction that was chosen before"},
          self.keep);
    visit({"least", Unit::None, {-1, 1}, search(-0.2, 0.8), "A kick that is worth less is not done"},
          self.least);
  }
};

}  // namespace nonet::team
