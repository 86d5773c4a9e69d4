// Declared parameters of playing the ball: where to, and how the robot comes to push or kick it.
#pragma once

#include "nonet/config/parameters.h"

namespace nonet::team {

/// Where the ball is to be played: into the goal, around an opponent in the way.
struct BallTargetParameters {
  double atGoal = 3.5;
  double atGoalInside = 0.3;
  double behindLine = 0.2;
  double insidePost = 0.9;
  double afar = 3.0;
  double middle = 0.2;
  double cornerDepth = 1.0;
  double cornerAside = 0.3;
  double cornerBack = 1.5;
  double laneWidth = 0.7;
  double openPostMargin = 0.25;
  double openTurnCost = 0.15;
  double openMiddle = 0.05;
  double aimSpread = 0.15;
  double barReach = 2.1;
  double barWidth = 0.45;
  double barCost = 0.8;
  double facingCost = 0.07;
  double keep = 0.2;
  double touchLineMargin = 0.2;
  double rollsOn = 1.4;
  double postMargin = 0.1;
  double around = 2.0;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    using namespace config;
    visit({"atGoal",
           Unit::Metre,
           {0, 30},
           fixed,
           "Nearer to the goal the ball goes to the place that opponents leave most open"},
          self.atGoal);
    visit({"atGoalInside",
           Unit::Metre,
           {0, 1},
           fixed,
           "The place left most open (atGoal) counts only for a ball this much nearer to the middle than the "
           "45 degree lines from the posts"},
          self.atGoalInside);
    visit({"behindLine", Unit::Metre, {0, 2}, fixed, "Aim this far behind the goal line"}, self.behindLine);
    visit({"insidePost", Unit::Metre, {0, 1}, fixed, "From near: least distance from the posts"},
          self.insidePost);
    visit({"afar",
           Unit::Metre,
           {0, 30},
           fixed,
           "From farther than this aim at the middle of the goal, since a push aside on the way adds up"},
          self.afar);
    visit({"middle", Unit::Metre, {0, 1}, fixed, "From afar: half the width of that middle"}, self.middle);
    visit({"cornerDepth",
           Unit::Metre,
           {0, 10},
           fixed,
           "A ball nearer to the goal line and beside the goal first goes back to the middle"},
          self.cornerDepth);
    visit({"cornerAside", Unit::Metre, {0, 5}, fixed, "Beside the goal: this far outside the post"},
          self.cornerAside);
    visit({"cornerBack", Unit::Metre, {0, 10}, fixed, "Back to the middle: this far in front of the goal"},
          self.cornerBack);
    visit({"laneWidth",
           Unit::Metre,
           {0, 5},
           fixed,
           "A way that opponents leave wider than this is as good as free"},
          self.laneWidth);
    visit({"openPostMargin", Unit::Metre, {0, 1}, fixed, "Open goal: least distance from the posts"},
          self.openPostMargin);
    visit({"openTurnCost",
           Unit::Metre,
           {0, 5},
           fixed,
           "Open goal: lane width that a turn of the robot by 1 rad must be worth"},
          self.openTurnCost);
    visit({"openMiddle",
           Unit::None,
           {0, 5},
           fixed,
           "Open goal: lane width that each metre off the middle must be worth"},
          self.openMiddle);
    visit({"aimSpread",
           Unit::Radian,
           {0.01, 1},
           search(0.03, 0.4),
           "Open goal: deviation of a ball's direction, which makes places hard to hit that are seen aslant"},
          self.aimSpread);
    visit({"barReach",
           Unit::Metre,
           {0, 10},
           search(0.8, 2.5),
           "Opponents bar directions of the ball up to this distance from it"},
          self.barReach);
    visit({"barWidth",
           Unit::Radian,
           {0.01, 3.2},
           search(0.3, 1.0),
           "An opponent bars this to either side in full, and fades over as much again"},
          self.barWidth);
    visit({"barCost",
           Unit::None,
           {0, 10},
           search(0, 1.6),
           "Cost of a direction that is barred in full; one that points away from the target costs 1"},
          self.barCost);
    visit({"facingCost",
           Unit::None,
           {0, 5},
           search(0, 0.5),
           "Cost of a direction per squared radian that the robot must turn for it"},
          self.facingCost);
    visit({"keep",
           Unit::None,
           {0, 2},
           search(0, 0.6),
           "Around an opponent: what another direction must be better by than the present one"},
          self.keep);
    visit({"touchLineMargin",
           Unit::Metre,
           {0, 2},
           fixed,
           "A direction in which a pushed ball comes nearer to the touch line is out"},
          self.touchLineMargin);
    visit({"rollsOn",
           Unit::Metre,
           {0, 10},
           search(0.5, 3),
           "A pushed ball rolls this far: directions that lead out of the field by then cost 1 and are not "
           "dribbled in; 0: nobody asks"},
          self.rollsOn);
    visit({"postMargin",
           Unit::Metre,
           {0, 1},
           search(0, 0.4),
           "Over the goal line is out unless it is this far inside the posts"},
          self.postMargin);
    visit(
        {"around", Unit::Metre, {0.1, 10}, search(0.8, 3), "Around an opponent: the ball is played this far"},
        self.around);
  }
};

/// Kicks at the goal (shot.cpp).
struct ShotParameters {
  double distance = 12.0;
  double room = 0.25;
  double lane = 0.25;
  double widest = 0.7;
  double spread = 0.06;
  double hits = 0.6;
  double reach = 0.85;
  double postMargin = 0.15;
  double low = 3.5;
  double keep = 0.7;
  double keepWithin = 0.3;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    using namespace config;
    visit({"distance", Unit::Metre, {0, 30}, search(0, 14), "Shoot from this near to the goal; 0: never"},
          self.distance);
    visit({"room",
           Unit::Metre,
           {0, 10},
           search(0.2, 1.8),
           "Shoot only when no opponent is nearer to the ball; a share of it (ball.kickPress) once in place"},
          self.room);
    visit({"lane", Unit::Metre, {0, 2}, search(0.1, 0.8), "Least distance of opponents from the ball's way"},
          self.lane);
    visit({"widest", Unit::Metre, {0, 5}, fixed, "A lane that is wider than this is as good as free"},
          self.widest);
    visit({"spread",
           Unit::Radian,
           {0.01, 1},
           fixed,
           "Standard deviation of the direction of kicks (kick-report)"},
          self.spread);
    visit({"hits",
           Unit::None,
           {0, 1},
           search(0.3, 0.9),
           "Least probability that the ball crosses the line between the posts and below the bar if nobody "
           "stops it"},
          self.hits);
    visit({"reach", Unit::None, {0, 1}, fixed, "Share of a kick's distance in which the ball is still fast"},
          self.reach);
    visit({"postMargin", Unit::Metre, {0, 1}, fixed, "Aim this far inside the posts"}, self.postMargin);
    visit({"low",
           Unit::Metre,
           {0, 10},
           search(0, 5),
           "From this near also with soft kicks, that stay below the bar; 0: never"},
          self.low);
    visit(
        {"keep",
         Unit::None,
         {0, 1},
         search(0.4, 1.0),
         "A shot under way goes on with this share of `lane` and `hits`: who gives it up runs into somebody"},
        self.keep);
    visit({"keepWithin",
           Unit::Metre,
           {0, 3},
           fixed,
           "A shot is under way, for `keep`, with the ball nearer than this"},
          self.keepWithin);
  }
};

/// How the player on the ball goes behind it, dribbles and kicks (behaviors/).
struct BallHandlingParameters {
  double behindBall = 0.15;
  double standOff = 0.28;
  double circleRadius = 0.3;
  double circleOpen = 1.2;
  double circleLead = 0.08;
  double circleAhead = 0.4;
  double circleRolling = 0.4;
  double turnAlong = 4.0;
  double turnLast = 0.2;
  double turnedRoom = 0.05;
  double turnedAngle = 1.6;
  double circleRoom = 0.3;
  double circleEither = 0.2;
  double dribbleThrough = 0.6;
  double alignedAngle = 0.45;
  double alignedAside = 0.15;
  bool kick = true;
  double kickApproach = 1.2;
  double kickOpponentDistance = 1.8;
  double kickRoom = 0.6;
  double kickRoomPace = 0.7;
  double kickLane = 0.3;
  double handleDistance = 0.9;
  double waitBehind = 0.35;
  double kickPress = 0.25;
  double kickHold = 0.5;
  double kickHoldAngle = 0.4;
  double kickLaneLength = 3.0;
  double kickRolling = 0.3;
  double kickBehind = 0.08;
  double kickBesides = 0.055;
  double alignedBehind = 0.05;
  double waitRoom = 0.25;
  double awaitMargin = 1.5;
  double awaitAside = 0.3;
  double kickLead = 0.5;
  double wayRoom = 0.5;
  double sideKeep = 0.3;
  double sideLoss = 0.2;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    using namespace config;
    visit({"behindBall", Unit::Metre, {0.05, 2}, search(0.1, 0.5), "Approach point: torso behind the ball"},
          self.behindBall);
    visit({"standOff",
           Unit::Metre,
           {0, 2},
           search(0.18, 0.5),
           "Approach point while a touch would roll the ball out of the field: torso behind the ball"},
          self.standOff);
    visit({"circleRadius",
           Unit::Metre,
           {0.1, 3},
           search(0.2, 0.6),
           "Distance kept from the ball when walking around it"},
          self.circleRadius);
    visit({"circleOpen",
           Unit::Radian,
           {0.1, 3.2},
           search(0.5, 2),
           "This angle from straight behind the ball the way around it begins to come in"},
          self.circleOpen);
    visit({"circleLead",
           Unit::Second,
           {0, 0.5},
           search(0, 0.2),
           "The way behind the ball begins where the present steps lead in this time"},
          self.circleLead);
    visit({"circleAhead",
           Unit::Second,
           {0, 2},
           search(0, 1),
           "The way behind the ball leads to where the ball will be in this time, or sooner if the robot is "
           "there sooner"},
          self.circleAhead);
    visit({"circleRolling",
           Unit::MetrePerSecond,
           {0, 10},
           search(0, 1),
           "On the way behind the ball a ball slower than this counts as lying"},
          self.circleRolling);
    visit({"turnAlong",
           Unit::None,
           {0, 20},
           search(1, 8),
           "On the way behind the ball the robot faces where it walks; it turns to the ball's way when the "
           "turn takes more than so many radians for each metre left"},
          self.turnAlong);
    visit({"turnLast",
           Unit::Metre,
           {0, 1},
           search(0, 0.5),
           "The turn to the ball's way (turnAlong) should be done this long before the end of the way behind "
           "the ball"},
          self.turnLast);
    visit({"turnedRoom",
           Unit::Metre,
           {0, 0.5},
           search(0, 0.2),
           "Farther behind the ball by this while the robot is turned away: toes and heels reach far"},
          self.turnedRoom);
    visit({"turnedAngle",
           Unit::Radian,
           {0.1, 3.2},
           fixed,
           "The room is that in full when turned away by this, and grows in proportion until then"},
          self.turnedAngle);
    visit({"circleRoom",
           Unit::Metre,
           {0, 2},
           search(0.15, 0.5),
           "An opponent so near to the way around the ball stands in it: then around the other side"},
          self.circleRoom);
    visit({"circleEither",
           Unit::Metre,
           {0, 2},
           search(0, 0.4),
           "A robot that is not farther than this from the ball's way goes around it on either side, the one "
           "that is free (circleRoom)"},
          self.circleEither);
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
    visit({"kickApproach",
           Unit::Radian,
           {0, 3.2},
           search(0.5, 3.1),
           "Kick: the last steps go straight to their place when the target lies within this angle"},
          self.kickApproach);
    visit({"kickOpponentDistance",
           Unit::Metre,
           {0, 10},
           search(0.3, 2.5),
           "Kick when no opponent is nearer to the ball; a share of it (kickPress) once in place"},
          self.kickOpponentDistance);
    visit({"kickRoom",
           Unit::Metre,
           {0, 10},
           search(0.1, 1),
           "Before the robot is in its place it may kick when no opponent is nearer to the ball than this"},
          self.kickRoom);
    visit({"kickRoomPace",
           Unit::MetrePerSecond,
           {0, 10},
           search(0.3, 1.2),
           "The room for a kick (kickRoom) grows by this for each second until the foot can meet the ball"},
          self.kickRoomPace);
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
    visit({"kickPress",
           Unit::None,
           {0, 1},
           fixed,
           "Kick: share of kickOpponentDistance that holds once in place"},
          self.kickPress);
    visit({"kickLaneLength",
           Unit::Metre,
           {0.1, 20},
           fixed,
           "Kick: length of the ball's way that kickLane looks at"},
          self.kickLaneLength);
    visit({"kickRolling",
           Unit::MetrePerSecond,
           {0, 5},
           search(0.2, 0.8),
           "Kick: a faster ball is not where it was when the foot comes"},
          self.kickRolling);
    visit({"kickBehind", Unit::Metre, {0, 1}, fixed, "Kick: the last steps begin this far behind the ball"},
          self.kickBehind);
    visit({"kickBesides",
           Unit::Metre,
           {0, 1},
           fixed,
           "Kick: the last steps begin where the ball lies less far aside than ahead, and this much more"},
          self.kickBesides);
    visit({"alignedBehind", Unit::Metre, {0, 1}, search(0, 0.12), "Dribble when this far behind the ball"},
          self.alignedBehind);
    visit({"kickHold",
           Unit::Metre,
           {0, 3},
           fixed,
           "With the ball nearer than this a kick that is lined up is held, whoever will be first where it "
           "goes; "
           "only the room (kickRoom) must be left"},
          self.kickHold);
    visit({"kickHoldAngle",
           Unit::Radian,
           {0, 3.2},
           fixed,
           "A kick that is lined up (kickHold) is given up for a direction that differs by more than this"},
          self.kickHoldAngle);
    visit({"awaitMargin",
           Unit::Second,
           {-10, 100},
           search(0, 5),
           "A ball rolls out before it is kicked when no opponent is there until so long after"},
          self.awaitMargin);
    visit({"awaitAside",
           Unit::Metre,
           {0, 2},
           fixed,
           "Who waits for a ball to roll out keeps this far from its way"},
          self.awaitAside);
    visit({"kickLead",
           Unit::Second,
           {-100, 100},
           search(-3, 3),
           "Kick: one of us must be sooner by this where the ball comes to rest; a shot need not"},
          self.kickLead);
    visit(
        {"waitRoom", Unit::Metre, {0, 2}, fixed, "Set piece: room that the waiting taker leaves to the ball"},
        self.waitRoom);
    visit({"wayRoom", Unit::Metre, {0, 2}, search(0.4, 1), "Room left to others on the way to the ball"},
          self.wayRoom);
    visit({"sideKeep",
           Unit::Second,
           {0, 5},
           fixed,
           "A kick to the side that motion lines up for is kept unless another one is better by this"},
          self.sideKeep);
    visit({"sideLoss",
           Unit::None,
           {0, 10},
           search(0.05, 0.5),
           "What each metre less of a kick to the side is worth, s"},
          self.sideLoss);
  }
};

}  // namespace nonet::team
