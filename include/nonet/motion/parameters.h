// Declared parameters of the motion stage.
#pragma once

#include "nonet/config/parameters.h"
#include "nonet/motion/fall_control.h"
#include "nonet/motion/head_control.h"
#include "nonet/motion/kick_parameters.h"
#include "nonet/motion/skill_parameters.h"
#include "nonet/motion/walk/control.h"

namespace nonet::motion {

struct ControlParameters {
  double proportional = 1.0;
  double integral = 0.0;
  double derivative = 0.0;
  double stopMargin = 0.002;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    using namespace config;
    visit({"proportional", Unit::None, {0.0, 2.0}, fixed, "Share of the predicted error closed in one cycle"},
          self.proportional);
    visit({"integral", Unit::None, {0.0, 2.0}, fixed, "Share of the summed error (one summand per cycle)"},
          self.integral);
    visit({"derivative", Unit::None, {-1.0, 1.0}, fixed, "Share of the error's change in one cycle"},
          self.derivative);
    visit({"stopMargin", Unit::Radian, {0.0, 0.1}, fixed, "Distance that targets keep from a joint's stops"},
          self.stopMargin);
  }
};

struct TransitionParameters {
  double standTime = 0.5;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    using namespace config;
    visit({"standTime", Unit::Second, {0.02, 5.0}, fixed, "Time to take the stand from another pose"},
          self.standTime);
  }
};

struct MotionParameters {
  ControlParameters control;
  TransitionParameters transition;
  WalkSelection selection;
  WalkSets sets;
  RunParameters run;
  HeadParameters head;
  FallParameters fall;
  KickParameters kick;
  SkillParameters skills;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    visit.group("control", self.control);
    visit.group("transition", self.transition);
    visit.group("selection", self.selection);
    visit.group("walk", self.sets.goToTarget);
    visit.group("sprint", self.sets.sprint);
    visit.group("run", self.run);
    visit.group("sidestep", self.sets.sidestep);
    visit.group("positioning", self.sets.positioning);
    visit.group("dribble", self.sets.dribble);
    visit.group("head", self.head);
    visit.group("fall", self.fall);
    visit.group("kick", self.kick);
    visit.group("skills", self.skills);
  }
};

}  // namespace nonet::motion
