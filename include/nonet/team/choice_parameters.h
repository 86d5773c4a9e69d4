// Declared parameters of the choice between kicking and dribbling (ball_choice.h).
#pragma once

#include "nonet/config/parameters.h"

namespace nonet::team {

struct ChoiceParameters {
  bool use = false;  // not proven yet: docs/history.md
  double worthMost = 0.3;
  double worthScale = 6.0;
  double length = 0.9;
  double shotLength = 0.85;
  double spread = 0.06;
  double blockWidth = 0.3;
  double blockGrowth = 0.12;
  double ownPace = 1.1;
  double opponentPace = 0.6;
  double arrivalSpread = 0.8;
  double setupStand = 0.65;
  double setupWalk = 0.3;
  double kickPace = 1.1;
  double kickAround = 0.8;
  double opponentReach = 0.25;
  double setupSpread = 0.4;
  double dribbleAhead = 3.0;
  double dribbleLoss = 0.6;
  double out = 0.5;
  double keep = 0.02;
  double keepPlan = 0.05;
  double shortPass = 0.85;
  double late = 1.0;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    using namespace config;
    visit({"use", Unit::None, {0, 1}, fixed, "Whether kicks and dribbles are weighed by what they are worth"},
          self.use);
    visit({"worthMost", Unit::None, {0, 1}, search(0.2, 0.9), "Goals that the ball at the goal is worth"},
          self.worthMost);
    visit({"worthScale",
           Unit::Metre,
           {0.5, 50},
           search(3, 15),
           "Distance from the goal over which the worth of the ball falls to a third"},
          self.worthScale);
    visit({"length",
           Unit::None,
           {0.1, 1},
           fixed,
           "Length of a kick in play as a share of the longest that its head declares"},
          self.length);
    visit({"shotLength",
           Unit::None,
           {0.1, 1},
           fixed,
           "Length of a shot, which must cross the line, as a share of the longest that its kick's head "
           "declares"},
          self.shotLength);
    visit({"spread", Unit::Radian, {0.001, 1}, fixed, "Standard deviation of the direction of a kick"},
          self.spread);
    visit(
        {"blockWidth", Unit::Metre, {0, 2}, search(0.1, 0.8), "A robot this near to the ball's way stops it"},
        self.blockWidth);
    visit({"blockGrowth",
           Unit::None,
           {0, 2},
           search(0, 0.5),
           "How much wider that is for each metre of the ball's way: robots have time to step in"},
          self.blockGrowth);
    visit({"ownPace", Unit::MetrePerSecond, {0.05, 5}, fixed, "Of team mates on their way to a kicked ball"},
          self.ownPace);
    visit({"opponentPace", Unit::MetrePerSecond, {0.05, 5}, search(0.3, 1.2), "Of opponents likewise"},
          self.opponentPace);
    visit({"arrivalSpread",
           Unit::Second,
           {0.01, 10},
           fixed,
           "Lead in time that makes it nearly certain who comes first"},
          self.arrivalSpread);
    visit({"setupStand",
           Unit::Second,
           {0, 10},
           search(0.3, 3),
           "Besides the way: until a kick from a stand begins"},
          self.setupStand);
    visit({"setupWalk",
           Unit::Second,
           {0, 10},
           search(0.1, 2),
           "Besides the way: until a kick out of the walk begins"},
          self.setupWalk);
    visit({"kickPace", Unit::MetrePerSecond, {0.05, 5}, fixed, "Of the way to the ball for a kick"},
          self.kickPace);
    visit({"kickAround",
           Unit::Second,
           {0, 10},
           search(0.2, 2),
           "What a kick at right angles to the way to the ball, or to where the robot looks, takes longer"},
          self.kickAround);
    visit({"opponentReach",
           Unit::Metre,
           {0, 1},
           fixed,
           "An opponent whose torso is this near to the ball plays it"},
          self.opponentReach);
    visit({"setupSpread", Unit::Second, {0.01, 10}, fixed, "Uncertainty of that"}, self.setupSpread);
    visit({"dribbleAhead", Unit::Metre, {0, 10}, search(0.5, 4), "How far a dribble carries the ball"},
          self.dribbleAhead);
    visit({"dribbleLoss",
           Unit::None,
           {0, 1},
           search(0, 1),
           "Probability to lose the ball in a dribble that an opponent bars in full"},
          self.dribbleLoss);
    visit({"out",
           Unit::None,
           {0, 1},
           fixed,
           "Share of the ball's worth that opponents gain by a throw-in or goal kick there"},
          self.out);
    visit({"keep", Unit::None, {0, 1}, fixed, "A kick that is on its way is worth so much more"}, self.keep);
    visit({"keepPlan", Unit::None, {0, 1}, fixed, "At a set piece what was planned is worth so much more"},
          self.keepPlan);
    visit({"shortPass",
           Unit::None,
           {0, 1},
           search(0.5, 1),
           "Set pieces: probability that the pass to the one who stands next to the ball arrives"},
          self.shortPass);
    visit({"late",
           Unit::Second,
           {0, 5},
           search(0, 2),
           "Our players come so much later to a kicked ball than reckoned: of the first ten long set pieces "
           "opponents had seven"},
          self.late);
  }
};

}  // namespace nonet::team
