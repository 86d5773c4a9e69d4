// Declared parameters of where players stand and how they go there.
#pragma once

#include "nonet/config/parameters.h"
#include "nonet/math/angle.h"

namespace nonet::team {

/// Role positions relative to the ball (offensive group) and on the line from the own goal to the ball
/// (backs), after [MacAlpine 2012a, section 6.1 and figure 5].
struct FormationParameters {
  double forwardAhead = 6.0;
  double forwardAside = 2.5;
  double wingBehind = 0.8;
  double wingAside = 1.1;
  double stopperBehind = 1.3;
  double supporterBehind = 2.5;
  double firstBackFromGoal = 4.0;
  double secondBackFromGoal = 7.0;
  double backAside = 0.7;
  double joinFrom = 13.0;
  double joinBehind = 2.3;
  double lineBehindBall = 5.0;
  double lineBehindOpponent = 3.0;
  double markWithin = 0.0;
  double markFree = 1.5;
  double markBehind = 0.6;
  double touchLineMargin = 0.7;
  double apart = 1.0;
  double areaMargin = 0.3;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    using namespace config;
    visit({"forwardAhead", Unit::Metre, {0, 10}, search(1, 8), "Forwards: ahead of the ball"},
          self.forwardAhead);
    visit({"forwardAside", Unit::Metre, {0, 10}, search(1, 5), "Forwards: to the side of the ball"},
          self.forwardAside);
    visit({"wingBehind", Unit::Metre, {0, 10}, search(0.3, 5), "Wings: behind the ball"}, self.wingBehind);
    visit({"wingAside", Unit::Metre, {0, 10}, search(0.8, 6), "Wings: to the side of the ball"},
          self.wingAside);
    visit({"stopperBehind", Unit::Metre, {0, 10}, search(0.8, 4), "Stopper: behind the ball"},
          self.stopperBehind);
    visit({"supporterBehind", Unit::Metre, {0, 10}, search(1.5, 8), "Supporter: behind the ball"},
          self.supporterBehind);
    visit({"firstBackFromGoal",
           Unit::Metre,
           {1, 15},
           search(1.5, 5),
           "Nearer back: distance from the own goal"},
          self.firstBackFromGoal);
    visit({"secondBackFromGoal",
           Unit::Metre,
           {1, 15},
           search(3, 8),
           "Farther back: distance from the own goal"},
          self.secondBackFromGoal);
    visit({"backAside", Unit::Metre, {0, 3}, search(0, 1.5), "Backs: to either side of the line goal - ball"},
          self.backAside);
    visit({"joinFrom",
           Unit::Metre,
           {0, 60},
           search(12, 40),
           "A ball farther than this from the own goal: the farther back joins the attack"},
          self.joinFrom);
    visit({"joinBehind",
           Unit::Metre,
           {0, 10},
           search(1, 4),
           "Distance behind the ball of the back that has joined the attack (joinFrom)"},
          self.joinBehind);
    visit({"lineBehindBall",
           Unit::Metre,
           {0, 60},
           search(3, 15),
           "Nearer back: comes forward up to here behind the ball, if no opponent is farther back"},
          self.lineBehindBall);
    visit({"lineBehindOpponent",
           Unit::Metre,
           {-5, 30},
           search(0, 10),
           "The nearer back stays this far behind the foremost opponent, seen from the own goal"},
          self.lineBehindOpponent);
    visit({"markWithin",
           Unit::Metre,
           {0, 30},
           search(0, 15),
           "A ball nearer than this to the own goal: the wings mark opponents that are too; 0: never"},
          self.markWithin);
    visit({"markFree",
           Unit::Metre,
           {0, 10},
           search(0.5, 3),
           "Those nearer to the ball than this are left to the one on the ball"},
          self.markFree);
    visit({"markBehind",
           Unit::Metre,
           {0, 3},
           search(0.4, 1.5),
           "Who marks stands so far from the opponent, towards the own goal"},
          self.markBehind);
    visit({"touchLineMargin", Unit::Metre, {0, 3}, fixed, "Positions stay this far inside the field"},
          self.touchLineMargin);
    visit({"apart", Unit::Metre, {0, 3}, fixed, "Positions are at least this far from each other"},
          self.apart);
    visit({"areaMargin",
           Unit::Metre,
           {0, 3},
           fixed,
           "Positions but one stay this far outside the own penalty area"},
          self.areaMargin);
  }
};

/// Set pieces of the own team (set_play.h) and of the opponents.
struct SetPlayParameters {
  double passLength = 3;
  double behindPass = 0.45;
  double receiverMargin = 0.3;
  double receiverReady = 0.6;
  double kickInAngle = toRadians(65);
  double goalKickAngle = toRadians(35);
  double freeKickAngle = toRadians(65);
  double cornerBack = 5.5;
  double cornerAside = 2.5;
  double cornerLength = 5;
  double kickOffAngle = toRadians(-115);
  double kickOffLine = 0.6;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    using namespace config;
    visit({"passLength", Unit::Metre, {0.5, 10}, fixed, "How far the ball is kicked, but at corners"},
          self.passLength);
    visit({"behindPass",
           Unit::Metre,
           {0, 3},
           fixed,
           "The receiver waits this far on the own side of the way of the ball"},
          self.behindPass);
    visit(
        {"receiverMargin", Unit::Metre, {0, 3}, fixed, "The receiver stays this far inside the touch lines"},
        self.receiverMargin);
    visit({"receiverReady", Unit::Metre, {0, 5}, fixed, "The receiver is ready this near to its place"},
          self.receiverReady);
    visit({"kickInAngle", Unit::Radian, {0, 3.2}, fixed, "Kick-in: from the touch line into the field"},
          self.kickInAngle);
    visit({"goalKickAngle", Unit::Radian, {0, 3.2}, fixed, "Goal kick: from straight ahead to the middle"},
          self.goalKickAngle);
    visit({"freeKickAngle",
           Unit::Radian,
           {0, 3.2},
           fixed,
           "Free kick: from straight to the goal to the middle; near the goal from straight away from it"},
          self.freeKickAngle);
    visit(
        {"cornerBack", Unit::Metre, {0, 10}, fixed, "Corner: towards a point this far in front of the goal"},
        self.cornerBack);
    visit({"cornerAside",
           Unit::Metre,
           {0, 10},
           fixed,
           "Corner: towards a point this far aside from the middle, where the corner is"},
          self.cornerAside);
    visit({"cornerLength", Unit::Metre, {0.5, 10}, fixed, "Corner: how far the ball is kicked"},
          self.cornerLength);
    visit({"kickOffAngle",
           Unit::Radian,
           {-3.2, 3.2},
           fixed,
           "Kick-off: to the right and back, away from the opponents"},
          self.kickOffAngle);
    visit({"kickOffLine",
           Unit::Metre,
           {0, 5},
           fixed,
           "The others' kick-off: we stay this far behind the halfway line"},
          self.kickOffLine);
  }
};

/// Being beamed to the places for a kick-off (before_kick_off.cpp).
struct BeamParameters {
  double elsewhere = 0.7;
  double again = 2.0;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    using namespace config;
    visit({"elsewhere", Unit::Metre, {0, 10}, fixed, "A robot farther from its place is beamed again"},
          self.elsewhere);
    visit({"again", Unit::Second, {0, 20}, fixed, "Least time between two beams to one place"}, self.again);
  }
};

/// Walking slowly into opponents, as the referee wants it (charging.h).
struct ChargingParameters {
  double speed = 0.38;
  double reach = 0.8;
  double lead = 0.05;
  double closing = 0.3;
  double aside = 0.35;
  double touched = 0.15;
  double brake = 1.5;
  double offBall = 1.0;
  double offBallReach = 0.55;
  double offBallSpeed = 0.33;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    using namespace config;
    visit({"speed",
           Unit::MetrePerSecond,
           {0, 1},
           search(0, 0.6),
           "Speed at which one comes into contact: fouls begin at 0.4; 0: nobody slows down"},
          self.speed);
    visit({"reach", Unit::Metre, {0, 2}, search(0.3, 1.2), "Before opponents so near one brakes"},
          self.reach);
    visit({"lead",
           Unit::Metre,
           {-1, 2},
           search(0, 0.3),
           "An opponent nearer to the ball by this much has the right of way"},
          self.lead);
    visit({"closing",
           Unit::None,
           {-1, 1},
           search(0, 0.8),
           "Only a way whose cosine with that to the opponent is larger leads into it"},
          self.closing);
    visit({"aside",
           Unit::Metre,
           {0, 2},
           search(0.2, 0.5),
           "Only a way that passes an opponent nearer than this leads into it"},
          self.aside);
    visit({"touched",
           Unit::Metre,
           {0, 1},
           fixed,
           "Who is so near to the ball has touched it, and may run into anybody for a second"},
          self.touched);
    visit({"brake",
           Unit::MetrePerSecondSquared,
           {0, 10},
           search(0, 4),
           "Deceleration before a contact; 0: from reach on at the speed of the contact"},
          self.brake);
    visit({"offBall",
           Unit::Metre,
           {0, 100},
           fixed,
           "Who is farther from the ball than this, as is the opponent, has nothing to win by a contact"},
          self.offBall);
    visit({"offBallReach",
           Unit::Metre,
           {0, 3},
           search(0.4, 0.8),
           "There it goes slowly at this distance, less what is uncertain of it"},
          self.offBallReach);
    visit({"offBallSpeed", Unit::MetrePerSecond, {0, 1}, search(0, 0.4), "At this speed"}, self.offBallSpeed);
  }
};

/// Going somewhere among others (navigation.h).
struct NavigationParameters {
  double lookAhead = 0.5;
  double pace = 1.2;
  double fallenRoom = 0.2;
  double atBall = 0.6;
  double bodyRoom = 0.28;
  double headingDistance = 0.7;
  double turnCost = 0.2;
  double closeEnough = 0.12;
  double facing = 0.25;
  double crowded = 0.1;
  double detourStep = 1.0;
  double slowStep = 0.4;
  double squeezeFor = 0.4;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    using namespace config;
    visit({"lookAhead",
           Unit::Second,
           {0, 5},
           fixed,
           "Others are thought to walk on until one comes to them, but no longer than this"},
          self.lookAhead);
    visit({"pace", Unit::MetrePerSecond, {0.1, 5}, fixed, "At which one comes to them"}, self.pace);
    visit({"fallenRoom", Unit::Metre, {0, 2}, fixed, "More room around somebody who lies on the ground"},
          self.fallenRoom);
    visit({"atBall", Unit::Metre, {0, 3}, fixed, "Robots nearer to the ball take part in the duel"},
          self.atBall);
    visit({"bodyRoom", Unit::Metre, {0, 2}, fixed, "Between two torsos that just touch when both walk"},
          self.bodyRoom);
    visit({"turnCost",
           Unit::Metre,
           {0, 5},
           search(0, 1),
           "A way around that is longer by this needs 1 rad of turn less"},
          self.turnCost);
    visit({"headingDistance",
           Unit::Metre,
           {0, 5},
           fixed,
           "Nearer to the target the robot takes the heading of the target"},
          self.headingDistance);
    visit({"closeEnough", Unit::Metre, {0, 1}, fixed, "Arrived: distance to the target"}, self.closeEnough);
    visit({"facing", Unit::Radian, {0, 3.2}, fixed, "Arrived: error of the heading"}, self.facing);
    visit({"crowded",
           Unit::Metre,
           {0, 2},
           fixed,
           "Beside bodyRoom: gives way when less than this is left to somebody"},
          self.crowded);
    visit({"detourStep",
           Unit::Metre,
           {0.05, 5},
           fixed,
           "On a way around one walks at least as fast as to a place so far ahead"},
          self.detourStep);
    visit({"slowStep",
           Unit::Metre,
           {0.05, 5},
           fixed,
           "When giving way one walks at least as fast as to a place so far ahead: the walk slows down "
           "towards a near target"},
          self.slowStep);
    visit({"squeezeFor",
           Unit::Metre,
           {0, 100},
           search(0, 2),
           "To the ball one goes between others with less room when the way is shorter by this"},
          self.squeezeFor);
  }
};

}  // namespace nonet::team
