// Which kick, and the last steps to it: a request "the ball that lies there, to that place" -> the cheapest
// kick of the catalogue, the way to where the robot must stand for it, and the moment to begin.
//
// Needs: the catalogue, the request, the walk. Gives: a speed to walk with, or the kick to begin now.
// After [MacAlpine 2012a, section 5.2]: the cost of a kick is the way to its place in metres, the turn as a
// share of a full one, half a metre when the robot must go around the ball; the time to contact is ours.
#pragma once

#include <optional>

#include "nonet/config/parameters.h"
#include "nonet/motion/kick_catalogue.h"
#include "nonet/motion/request.h"
#include "nonet/motion/walk/engine.h"

namespace nonet::motion {

struct KickParameters {
  double turnCost = 0.16;
  double aroundCost = 0.5;
  double timeCost = 1.0;
  double shortCost = 0.2;
  double standCost = 0.4;
  double keep = 0.1;
  double angle = 0.2;
  double stay = 1.5;
  double stopDrift = 0.01;
  double gain = 3.5;
  double leastSpeed = 0.1;
  double mostSpeed = 0.8;
  double strideSpeed = 0.12;
  double strideTurn = 0.24;
  double quietRate = 0.35;
  double quietTime = 0.04;

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
    visit({"gain", Unit::Hertz, {0.1, 20}, search(1, 8), "Speed per distance in the last steps"}, self.gain);
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
    visit({"strideTurn", Unit::RadianPerSecond, {0, 10}, fixed, "and turn slower than this"},
          self.strideTurn);
    visit({"quietRate",
           Unit::RadianPerSecond,
           {0, 10},
           fixed,
           "Kicks from a stand begin when the torso turns slower than this"},
          self.quietRate);
    visit({"quietTime", Unit::Second, {0, 2}, fixed, "and has done so for this long"}, self.quietTime);
  }
};

/// What the kick control wants in a cycle.
struct KickStep {
  const KickOption* option = nullptr;  // the chosen kick; null: there is none that could
  bool inPlace = false;                // the ball lies where that kick wants it
  bool begin = false;                  // now; otherwise walk on:
  bool stand = false;                  // come to a stand
  WalkVelocity walk;                   // or these steps
  Vector2 ball = Vector2::Zero();      // where the kick is to find the ball, robot frame, m
};

class KickControl {
 public:
  KickControl(const KickCatalogue& catalogue, const KickParameters& parameters)
      : catalogue_(&catalogue), parameters_(parameters) {}

  /// One cycle in which a kick is asked for. `quiet`: s, for which the robot has stood quietly.
  KickStep update(const KickTo& request, const WalkEngine& walk, double quiet);
  /// Nothing is asked for, or a kick has begun: the next request chooses anew.
  void reset() { chosen_ = nullptr; }

 private:
  struct Way {                          // to the place for a kick
    Vector2 place = Vector2::Zero();    // robot frame, m
    double turn = 0.0;                  // rad
    Vector2 missing = Vector2::Zero();  // of the ball's place as it lies now, m
  };

  Way wayTo(const KickOption& option, const KickTo& request) const;
  double cost(const KickOption& option, const KickTo& request) const;
  const KickOption* choose(const KickTo& request) const;
  WalkVelocity lastSteps(const Way& way) const;

  const KickCatalogue* catalogue_;
  KickParameters parameters_;
  const KickOption* chosen_ = nullptr;
  bool wasInPlace_ = false;
};

}  // namespace nonet::motion
