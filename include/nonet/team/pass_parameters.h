// Declared parameters of passes: who plays one to whom (pass.h), and who runs to one
// (behaviors/run_to_pass.cpp).
#pragma once

#include "nonet/config/parameters.h"

namespace nonet::team {

struct PassParameters {
  bool use = true;
  double least = 3.5;
  double most = 9.0;
  double room = 0.8;
  double fit = 0.15;
  double rollTime = 2.0;
  double runStep = 1.0;
  double margin = 0.7;
  double ours = 0.7;
  double lane = 0.3;
  double better = 0.02;
  double far = 10.0;
  double farLeast = 2.2;
  double farBetter = 0.0;
  double farPressed = 4.0;
  double keep = 0.03;
  double hold = 0.85;
  double press = 1.0;
  double same = 1.0;
  double before = 0.3;
  double late = 1.0;
  double strays = 2.0;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    using namespace config;
    visit({"use", Unit::None, {}, fixed, "Whether the ball is passed in open play"}, self.use);
    visit({"least", Unit::Metre, {0, 30}, search(1.5, 5), "Passes are at least so long"}, self.least);
    visit({"most", Unit::Metre, {0, 30}, search(5, 15), "Passes are at most so long"}, self.most);
    visit({"room",
           Unit::Metre,
           {0, 10},
           search(0.3, 2),
           "Pass only when no opponent is nearer to the ball; a share of it (ball.kickPress) once in place"},
          self.room);
    visit({"press",
           Unit::None,
           {0, 1},
           fixed,
           "Share of that room (room) that a pass needs while it is lined up"},
          self.press);
    visit({"fit",
           Unit::None,
           {0, 1},
           fixed,
           "A kick that always goes equally far serves passes that are shorter or longer by this share"},
          self.fit);
    visit(
        {"rollTime", Unit::Second, {0, 10}, fixed, "From the kick until the ball is slow enough to be taken"},
        self.rollTime);
    visit({"runStep",
           Unit::Metre,
           {0, 5},
           search(0.5, 2),
           "The receiver can be sent towards the goal by this, and by twice this"},
          self.runStep);
    visit({"margin", Unit::Metre, {0, 5}, fixed, "A pass ends at least so far inside the field"},
          self.margin);
    visit({"ours",
           Unit::None,
           {0, 1},
           search(0.5, 0.95),
           "The receiver must be first with at least this probability"},
          self.ours);
    visit({"lane",
           Unit::None,
           {0, 1},
           search(0.1, 0.6),
           "Opponents may stop the ball on its way with at most this probability"},
          self.lane);
    visit({"better",
           Unit::None,
           {0, 1},
           search(0, 0.05),
           "Goals that a pass must be worth more than running on with the ball"},
          self.better);
    visit({"far",
           Unit::Metre,
           {0, 50},
           search(5, 20),
           "With the ball farther from the goal than this, farLeast and farBetter stand for least and better "
           "of passes that lead nearer to it"},
          self.far);
    visit({"farLeast", Unit::Metre, {0, 30}, search(1.5, 5), "Far from the goal passes are at least so long"},
          self.farLeast);
    visit({"farBetter",
           Unit::None,
           {0, 1},
           search(0, 0.05),
           "Far from the goal a pass is worth at least so much more than running on"},
          self.farBetter);
    visit({"farPressed",
           Unit::Second,
           {0, 60},
           search(1, 10),
           "These two count only while an opponent needs less than this to the ball"},
          self.farPressed);
    visit({"keep",
           Unit::None,
           {0, 1},
           search(0, 0.05),
           "Goals that another pass must be worth more than the one that is on its way"},
          self.keep);
    visit({"hold",
           Unit::None,
           {0.1, 1},
           search(0.5, 1),
           "Share of `ours` that this one needs, and of what its lane must leave free"},
          self.hold);
    visit(
        {"same",
         Unit::Metre,
         {0, 10},
         fixed,
         "A pass counts as the one that is held (hold) if it ends at most this far from where that one did"},
        self.same);
    visit({"before",
           Unit::Metre,
           {0, 3},
           fixed,
           "The receiver waits so far behind the place, seen from the kicker"},
          self.before);
    visit({"late",
           Unit::Second,
           {0, 10},
           fixed,
           "The receiver forgets a pass that is so much later than announced"},
          self.late);
    visit({"strays",
           Unit::Metre,
           {0, 20},
           fixed,
           "The receiver forgets a pass whose ball rolls to so far from the place"},
          self.strays);
  }
};

}  // namespace nonet::team
