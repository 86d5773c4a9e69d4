// Declared parameters of the goalkeeper.
#pragma once

#include "nonet/config/parameters.h"

namespace nonet::team {

/// The goalkeeper (goalie.h, behaviors/dive.cpp, behaviors/guard_goal.cpp).
struct GoalieParameters {
  double outOfGoal = 0.9;
  double outShare = 1.0;
  double attackDistance = 2.0;
  double diveTime = 0.6;
  double highDiveTime = 0.4;
  double diveReach = 0.12;
  double sideStepSpeed = 0.4;
  double stepDelay = 0.3;
  double diveFarthest = 1.0;
  double keepClaim = 1.3;
  double claimAhead = 1.0;
  double claimMargin = 0.5;
  double clearanceAside = 6.0;
  double clearanceSure = 0.5;
  double diveBallSpeed = 0.5;
  double postMargin = 0.05;
  double inFrontOfLine = 0.2;
  double meetRate = 6.0;
  double room = 0.4;
  double blockTime = 0.5;
  double blockReach = 0.33;
  double blockHeight = 0.2;
  double highest = 0.9;
  double standHeight = 0.42;
  double backSpeed = 0.6;
  double foremost = 0.5;
  double fightDistance = 1.2;
  double oldestSight = 0.1;
  double secondLook = 0.05;
  double urgent = 0.5;
  double areaMargin = 0.5;
  bool stayInArea = false;
  bool dive = true;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    using namespace config;
    visit({"outOfGoal",
           Unit::Metre,
           {0, 5},
           search(0.2, 1.5),
           "Stands this far in front of the middle of the goal line"},
          self.outOfGoal);
    visit({"outShare",
           Unit::None,
           {0, 1},
           search(0.2, 0.8),
           "Goes out by this share of the ball's distance from the goal at most"},
          self.outShare);
    visit({"attackDistance",
           Unit::Metre,
           {0, 10},
           search(0.5, 4),
           "Goes to a ball that is this near to the goal centre"},
          self.attackDistance);
    visit({"diveTime", Unit::Second, {0, 5}, search(0.4, 2), "Dives when the ball arrives within this time"},
          self.diveTime);
    visit({"highDiveTime",
           Unit::Second,
           {0, 5},
           search(0.1, 1),
           "Dives within this time for a ball that is as high above the ground as it passes aside"},
          self.highDiveTime);
    visit(
        {"blockTime", Unit::Second, {0, 5}, search(0.1, 1), "Blocks when the ball arrives within this time"},
        self.blockTime);
    visit({"blockReach",
           Unit::Metre,
           {0, 2},
           search(0.1, 0.5),
           "A ball passing nearer than this is blocked, not dived for"},
          self.blockReach);
    visit({"diveReach", Unit::Metre, {0, 2}, search(0.1, 0.5), "A ball passing farther aside needs a dive"},
          self.diveReach);
    visit({"sideStepSpeed",
           Unit::MetrePerSecond,
           {0, 2},
           search(0, 0.6),
           "What steps aside add to the reach each second, after stepDelay"},
          self.sideStepSpeed);
    visit({"stepDelay", Unit::Second, {0, 2}, search(0, 0.6), "Time after which a step aside begins to help"},
          self.stepDelay);
    visit({"diveFarthest", Unit::Metre, {0, 3}, search(0.5, 1.2), "A ball passing farther is out of reach"},
          self.diveFarthest);
    visit({"keepClaim",
           Unit::None,
           {1, 5},
           fixed,
           "An own claim of the ball holds up to this multiple of attackDistance"},
          self.keepClaim);
    visit({"claimAhead", Unit::Second, {0, 10}, fixed, "Claims the ball by where it will be after this time"},
          self.claimAhead);
    visit({"claimMargin",
           Unit::None,
           {0, 5},
           fixed,
           "A field player must be sooner at the ball by less than this share of keepBallTime for the goalie "
           "to claim it"},
          self.claimMargin);
    visit({"clearanceAside",
           Unit::Metre,
           {0, 20},
           fixed,
           "Clears the ball to a point of the halfway line this far beside the middle"},
          self.clearanceAside);
    visit({"clearanceSure",
           Unit::Metre,
           {0, 10},
           fixed,
           "A ball nearer to the middle goes to the side to which the goalie looks"},
          self.clearanceSure);
    visit({"diveBallSpeed",
           Unit::MetrePerSecond,
           {0, 10},
           fixed,
           "Dives only for a ball that comes faster than this towards the goal line"},
          self.diveBallSpeed);
    visit({"postMargin",
           Unit::Metre,
           {0, 1},
           fixed,
           "A shot that passes this far outside the post is still one for the goalie"},
          self.postMargin);
    visit({"inFrontOfLine", Unit::Metre, {0, 5}, fixed, "Never stands nearer to the goal line"},
          self.inFrontOfLine);
    visit({"meetRate",
           Unit::Hertz,
           {0, 50},
           fixed,
           "Steps into the way of a shot with so many metres a second for each metre that is missing"},
          self.meetRate);
    visit({"room", Unit::Metre, {0, 5}, fixed, "Room left to others, and to a ball that it may not touch"},
          self.room);
    visit({"blockHeight", Unit::Metre, {0, 1}, fixed, "A ball passing lower than this can be blocked"},
          self.blockHeight);
    visit({"highest",
           Unit::Metre,
           {0, 2},
           fixed,
           "A ball that passes the robot or the goal line higher than this is none for the goalie"},
          self.highest);
    visit({"standHeight",
           Unit::Metre,
           {0, 2},
           fixed,
           "Under a ball that passes it higher than this it steps back to where it comes down so low"},
          self.standHeight);
    visit({"backSpeed",
           Unit::MetrePerSecond,
           {0, 5},
           fixed,
           "Steps back under a high ball (standHeight) if this speed, after stepDelay, takes it there in "
           "time; 0: never"},
          self.backSpeed);
    visit({"foremost",
           Unit::Second,
           {-10, 10},
           search(-1, 1.5),
           "Comes out when it is sooner at the ball than every opponent by more than this"},
          self.foremost);
    visit({"fightDistance",
           Unit::Metre,
           {0, 10},
           search(0.5, 2.5),
           "A ball that is this near to the goal centre is fought for, whoever is sooner"},
          self.fightDistance);
    visit({"oldestSight",
           Unit::Second,
           {0, 1},
           fixed,
           "Throws itself only at a ball that it has seen within this time"},
          self.oldestSight);
    visit({"secondLook",
           Unit::Second,
           {0, 1},
           fixed,
           "For this long after a kick the ball's speed comes from one sighting: waits for another"},
          self.secondLook);
    visit({"urgent",
           Unit::Second,
           {0, 2},
           fixed,
           "Waits for no second look (secondLook) at a ball that arrives within this time"},
          self.urgent);
    visit({"areaMargin",
           Unit::Metre,
           {0, 2},
           fixed,
           "With stayInArea: plays no ball that is nearer than this to the edge of the penalty area"},
          self.areaMargin);
    visit({"stayInArea", Unit::None, {0, 1}, fixed, "Penalty shoot-out: leaving the area gives away a goal"},
          self.stayInArea);
    visit({"dive", Unit::None, {0, 1}, fixed, "Whether to dive at all"}, self.dive);
  }
};

}  // namespace nonet::team
