// Declared parameters of the choice of kicks and the last steps to them (kick_control.h).
#pragma once

#include "nonet/config/parameters.h"

namespace nonet::motion {

struct KickParameters {
  double turnCost = 0.16;
  double aroundCost = 0.5;
  double timeCost = 1.0;
  double shortCost = 0.2;
  double standCost = 0.4;
  double keep = 0.1;
  double angle = 0.15;
  double aim = 0.6;
  double stay = 2.0;
  double stopDrift = 0.01;
  double coast = 0.15;
  double drift = 0.0;
  double follow = 0.4;
  double gain = 8.0;
  double leastSpeed = 0.1;
  double mostSpeed = 0.8;
  double strideSpeed = 0.45;
  double strideTurn = 0.8;
  double leastPace = -0.02;
  double asidePace = 0.06;
  double comes = 0.15;
  double closing = 3.0;
  double quietRate = 0.35;
  double quietTime = 0.1;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    using namespace config;
    visit({"turnCost", Unit::None, {0, 5}, fixed, "Choice of a kick: metres that a turn by 1 rad is worth"},
          self.turnCost);
    visit({"aroundCost", Unit::Metre, {0, 5}, fixed, "Choice of a kick: cost of going around the ball"},
          self.aroundCost);
    visit({"timeCost",
           Unit::MetrePerSecond,
           {0, 10},
           fixed,
           "Choice of a kick: cost per second from its begin to contact"},
          self.timeCost);
    visit({"shortCost",
           Unit::None,
           {0, 10},
           fixed,
           "Choice of a kick: cost per metre that it carries too short or too far"},
          self.shortCost);
    visit({"standCost",
           Unit::Metre,
           {0, 5},
           fixed,
           "Choice of a kick: cost of coming to a stand before it, where it does not begin out of steps"},
          self.standCost);
    visit({"keep", Unit::Metre, {0, 5}, fixed, "A chosen kick is kept while no other is cheaper by this"},
          self.keep);
    visit({"angle", Unit::Radian, {0, 3.2}, fixed, "Largest error of the direction when a kick begins"},
          self.angle);
    visit({"aim",
           Unit::None,
           {0.1, 1},
           search(0.3, 1),
           "Share of the tolerances to reach before coming to a stand, which moves the robot"},
          self.aim);
    visit({"stay",
           Unit::None,
           {1, 5},
           fixed,
           "Tolerances grow by this factor while the robot comes to its stand for a kick"},
          self.stay);
    visit({"stopDrift",
           Unit::Metre,
           {-0.1, 0.1},
           search(-0.05, 0.05),
           "How much farther ahead the ball lies when the robot has come from its steps to a stand"},
          self.stopDrift);
    visit({"coast",
           Unit::Second,
           {0, 1},
           search(0, 0.3),
           "How long the present steps go on when the robot is to walk elsewhere: the last steps look ahead "
           "by this"},
          self.coast);
    visit({"drift",
           Unit::MetrePerSecond,
           {-0.3, 0.3},
           search(0, 0.1),
           "Speed ahead of steps that go nowhere: looking ahead by `coast` leaves it out"},
          self.drift);
    visit({"follow",
           Unit::None,
           {0, 2},
           search(0, 1),
           "Share of the rolling ball's speed, and of its way until contact, that the last steps take along"},
          self.follow);
    visit({"gain", Unit::Hertz, {0.1, 20}, search(1, 12), "Speed per distance in the last steps"}, self.gain);
    visit({"leastSpeed",
           Unit::MetrePerSecond,
           {0, 1},
           search(0, 0.3),
           "Speed of the last steps besides what the gain gives"},
          self.leastSpeed);
    visit({"mostSpeed", Unit::MetrePerSecond, {0, 3}, search(0.3, 1.2), "Fastest speed of the last steps"},
          self.mostSpeed);
    visit({"strideSpeed",
           Unit::MetrePerSecond,
           {0, 3},
           fixed,
           "A kick out of the walk begins in steps that are slower than this"},
          self.strideSpeed);
    visit({"strideTurn",
           Unit::RadianPerSecond,
           {0, 10},
           fixed,
           "A kick out of the walk begins in steps that turn slower than this"},
          self.strideTurn);
    visit({"leastPace",
           Unit::MetrePerSecond,
           {-1, 1},
           fixed,
           "A kick out of the walk begins in steps that lead ahead at least this fast: a swing out of steps "
           "back is weak"},
          self.leastPace);
    visit({"asidePace",
           Unit::MetrePerSecond,
           {0, 3},
           fixed,
           "A kick out of the walk begins in steps that lead aside slower than this: out of others the foot "
           "passes the ball"},
          self.asidePace);
    visit({"comes",
           Unit::MetrePerSecond,
           {0, 3},
           fixed,
           "A kick out of the walk begins while the ball comes towards the robot slower than this"},
          self.comes);
    visit({"closing",
           Unit::MetrePerSecond,
           {0, 3},
           fixed,
           "A kick out of the walk begins in steps that lead ahead slower than this, or so much faster than "
           "the ball rolls away: out of others the foot gets under it"},
          self.closing);
    visit({"quietRate",
           Unit::RadianPerSecond,
           {0, 10},
           fixed,
           "Kicks from a stand begin when the torso turns slower than this"},
          self.quietRate);
    visit({"quietTime",
           Unit::Second,
           {0, 2},
           fixed,
           "Kicks from a stand begin when the torso has been quiet (quietRate) for this long"},
          self.quietTime);
  }
};

}  // namespace nonet::motion
