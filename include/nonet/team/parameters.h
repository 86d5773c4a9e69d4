// Declared parameters of the team stage: formation, ball handling, goalkeeping.
#pragma once

#include "nonet/config/parameters.h"

namespace nonet::team {

/// Role positions relative to the ball (offensive group) and on the line from the own goal to the ball
/// (backs), after [MacAlpine 2012a, section 6.1 and figure 5].
struct FormationParameters {
  double forwardAhead = 2.0;
  double forwardAside = 2.5;
  double wingBehind = 2.5;
  double wingAside = 3.0;
  double stopperBehind = 2.5;
  double supporterBehind = 4.0;
  double firstBackFromGoal = 3.0;
  double secondBackFromGoal = 5.5;
  double backAside = 0.7;
  double touchLineMargin = 0.7;
  double apart = 1.0;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    using namespace config;
    visit({"forwardAhead", Unit::Metre, {0, 10}, search(0.5, 4), "Forwards: ahead of the ball"},
          self.forwardAhead);
    visit({"forwardAside", Unit::Metre, {0, 10}, search(1, 5), "Forwards: to the side of the ball"},
          self.forwardAside);
    visit({"wingBehind", Unit::Metre, {0, 10}, search(1, 5), "Wings: behind the ball"}, self.wingBehind);
    visit({"wingAside", Unit::Metre, {0, 10}, search(1, 6), "Wings: to the side of the ball"},
          self.wingAside);
    visit({"stopperBehind", Unit::Metre, {0, 10}, search(0.8, 4), "Stopper: behind the ball"},
          self.stopperBehind);
    visit({"supporterBehind", Unit::Metre, {0, 10}, search(2, 8), "Supporter: behind the ball"},
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
    visit({"touchLineMargin", Unit::Metre, {0, 3}, fixed, "Positions stay this far inside the field"},
          self.touchLineMargin);
    visit({"apart", Unit::Metre, {0, 3}, fixed, "Positions are at least this far from each other"},
          self.apart);
  }
};

struct BallHandlingParameters {
  double behindBall = 0.25;
  double circleRadius = 0.45;
  double dribbleThrough = 0.6;
  double alignedAngle = 0.45;
  double alignedAside = 0.10;
  bool kick = true;
  double kickAhead = 0.165;
  double kickAheadTolerance = 0.03;
  double kickAside = 0.055;
  double kickAsideTolerance = 0.03;
  double kickAngle = 0.2;
  double kickApproach = 1.2;
  double kickGain = 3.5;
  double kickLeastSpeed = 0.1;
  double kickOpponentDistance = 1.8;
  double kickLane = 0.3;
  double handleDistance = 0.9;
  double waitBehind = 0.35;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    using namespace config;
    visit({"behindBall", Unit::Metre, {0.05, 2}, search(0.1, 0.5), "Approach point: torso behind the ball"},
          self.behindBall);
    visit({"circleRadius",
           Unit::Metre,
           {0.1, 3},
           search(0.3, 0.8),
           "Distance kept when walking around the ball"},
          self.circleRadius);
    visit(
        {"dribbleThrough", Unit::Metre, {0, 5}, search(0.2, 1.5), "Dribbling aims this far beyond the ball"},
        self.dribbleThrough);
    visit({"alignedAngle",
           Unit::Radian,
           {0, 3.2},
           search(0.1, 1.0),
           "Dribble when ball and target lie within this angle"},
          self.alignedAngle);
    visit({"alignedAside",
           Unit::Metre,
           {0, 1},
           search(0.03, 0.2),
           "Dribble when the ball lies this near to the line"},
          self.alignedAside);
    visit({"kick", Unit::None, {0, 1}, fixed, "Whether to kick at all"}, self.kick);
    visit({"kickAhead", Unit::Metre, {0, 1}, fixed, "Kick: ball this far ahead of the torso"},
          self.kickAhead);
    visit({"kickAheadTolerance", Unit::Metre, {0, 1}, fixed, "Kick: allowed error of kickAhead"},
          self.kickAheadTolerance);
    visit({"kickAside",
           Unit::Metre,
           {0, 0.3},
           fixed,
           "Kick: ball in front of the foot, this far from the middle"},
          self.kickAside);
    visit({"kickAsideTolerance", Unit::Metre, {0, 0.3}, fixed, "Kick: allowed error of kickAside"},
          self.kickAsideTolerance);
    visit({"kickAngle", Unit::Radian, {0, 3.2}, fixed, "Kick: allowed error of the heading"}, self.kickAngle);
    visit({"kickApproach",
           Unit::Radian,
           {0, 3.2},
           search(0.5, 3.1),
           "Kick: the last steps go straight to their place when the target lies within this angle"},
          self.kickApproach);
    visit({"kickGain", Unit::Hertz, {0.1, 20}, search(1, 8), "Kick: speed per distance in the last steps"},
          self.kickGain);
    visit({"kickLeastSpeed",
           Unit::MetrePerSecond,
           {0, 1},
           search(0, 0.3),
           "Kick: speed of the last steps besides what kickGain gives"},
          self.kickLeastSpeed);
    visit({"kickOpponentDistance",
           Unit::Metre,
           {0, 10},
           search(0.3, 2.5),
           "Kick only when no opponent is nearer to the ball; two fifths of it once in place"},
          self.kickOpponentDistance);
    visit({"kickLane",
           Unit::Metre,
           {0, 2},
           search(0.1, 0.8),
           "Kick only when no opponent is nearer to the first metres of the ball's way"},
          self.kickLane);
    visit({"handleDistance",
           Unit::Metre,
           {0.3, 3},
           search(0.5, 1.5),
           "Nearer to the ball others are not walked around any more"},
          self.handleDistance);
    visit({"waitBehind", Unit::Metre, {0.1, 2}, fixed, "Set piece: the taker waits this far behind the ball"},
          self.waitBehind);
  }
};

struct GoalieParameters {
  double outOfGoal = 0.6;
  double attackDistance = 2.0;
  double diveTime = 1.2;
  double diveReach = 0.2;
  double sideStepSpeed = 0.2;
  double diveFarthest = 0.9;
  bool dive = true;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    using namespace config;
    visit({"outOfGoal", Unit::Metre, {0, 5}, search(0.2, 1.5), "Stands this far in front of the goal line"},
          self.outOfGoal);
    visit({"attackDistance",
           Unit::Metre,
           {0, 10},
           search(0.5, 4),
           "Goes to a ball that is this near to the goal centre"},
          self.attackDistance);
    visit({"diveTime", Unit::Second, {0, 5}, search(0.4, 2), "Dives when the ball arrives within this time"},
          self.diveTime);
    visit({"diveReach", Unit::Metre, {0, 2}, search(0.1, 0.5), "A ball passing farther aside needs a dive"},
          self.diveReach);
    visit({"sideStepSpeed", Unit::MetrePerSecond, {0, 2}, search(0, 0.6), "What a step aside adds to it"},
          self.sideStepSpeed);
    visit({"diveFarthest", Unit::Metre, {0, 3}, search(0.5, 1.2), "A ball passing farther is out of reach"},
          self.diveFarthest);
    visit({"dive", Unit::None, {0, 1}, fixed, "Whether to dive at all"}, self.dive);
  }
};

/// How fast players are, for comparing their ways to the ball.
struct PaceParameters {
  double walkSpeed = 0.7;
  double turnSpeed = 1.5;
  double risingTime = 3.0;
  double wayAround = 0.8;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    using namespace config;
    visit({"walkSpeed", Unit::MetrePerSecond, {0.05, 5}, fixed, "Of a player on its way"}, self.walkSpeed);
    visit({"turnSpeed", Unit::RadianPerSecond, {0.1, 10}, fixed, "Of a player that turns"}, self.turnSpeed);
    visit({"risingTime", Unit::Second, {0, 10}, fixed, "From lying to walking"}, self.risingTime);
    visit({"wayAround", Unit::Metre, {0, 5}, fixed, "Longer way for one on the wrong side of the ball"},
          self.wayAround);
  }
};

struct TeamParameters {
  FormationParameters formation;
  BallHandlingParameters ball;
  GoalieParameters goalie;
  PaceParameters pace;
  double avoidDistance = 0.7;
  double onBallRoom = 1.2;
  double keepBallTime = 1.0;
  double clearOfOpponentKick = 2.3;
  double waitForReceiver = 8.0;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    using namespace config;
    visit.group("formation", self.formation);
    visit.group("ball", self.ball);
    visit.group("goalie", self.goalie);
    visit.group("pace", self.pace);
    visit({"avoidDistance", Unit::Metre, {0, 5}, search(0.4, 1.5), "Room left to other robots on the way"},
          self.avoidDistance);
    visit({"onBallRoom", Unit::Metre, {0, 5}, search(0.7, 2), "Room left to the team mate on the ball"},
          self.onBallRoom);
    visit({"keepBallTime",
           Unit::Second,
           {0, 10},
           search(0, 3),
           "Another player must be sooner at the ball by this to take it over"},
          self.keepBallTime);
    visit({"clearOfOpponentKick",
           Unit::Metre,
           {0, 10},
           fixed,
           "Distance from the ball while the opponent takes a kick"},
          self.clearOfOpponentKick);
    visit({"waitForReceiver",
           Unit::Second,
           {0, 15},
           fixed,
           "Own set piece: longest wait for the receiver before the ball is touched"},
          self.waitForReceiver);
  }
};

}  // namespace nonet::team
