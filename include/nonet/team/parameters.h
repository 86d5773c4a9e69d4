// Declared parameters of the team stage.
#pragma once

#include "nonet/config/parameters.h"
#include "nonet/team/aside_parameters.h"
#include "nonet/team/ball_parameters.h"
#include "nonet/team/carry_parameters.h"
#include "nonet/team/challenge_parameters.h"
#include "nonet/team/choice_parameters.h"
#include "nonet/team/goalie_parameters.h"
#include "nonet/team/pass_mode_parameters.h"
#include "nonet/team/pass_parameters.h"
#include "nonet/team/place_parameters.h"
#include "nonet/team/variant_parameters.h"

namespace nonet::team {

/// How fast players and ball are, for comparing the ways to the ball (play_time.h).
struct PaceParameters {
  double walkSpeed = 1.1;
  double turnSpeed = 3.0;
  double risingTime = 2.5;
  double wayAround = 0.5;
  double longestRoll = 6.0;
  double carryDistance = 0.5;
  double carrySpeed = 0.15;
  double carryAlong = 0.7;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    using namespace config;
    visit({"walkSpeed", Unit::MetrePerSecond, {0.05, 5}, fixed, "Of a player on its way"}, self.walkSpeed);
    visit({"turnSpeed", Unit::RadianPerSecond, {0.1, 10}, fixed, "Of a player that turns"}, self.turnSpeed);
    visit({"risingTime", Unit::Second, {0, 10}, fixed, "From lying to walking"}, self.risingTime);
    visit({"wayAround", Unit::Metre, {0, 5}, fixed, "Longer way for one on the wrong side of the ball"},
          self.wayAround);
    visit({"longestRoll", Unit::Second, {0, 60}, fixed, "A rolling ball is followed for so long"},
          self.longestRoll);
    visit({"carryDistance",
           Unit::Metre,
           {0, 5},
           fixed,
           "Largest distance between an opponent and the ball that it dribbles"},
          self.carryDistance);
    visit({"carrySpeed",
           Unit::MetrePerSecond,
           {0, 5},
           fixed,
           "An opponent slower than this does not dribble the ball on"},
          self.carrySpeed);
    visit({"carryAlong",
           Unit::None,
           {0, 1},
           fixed,
           "An opponent dribbles when the cosine between its way and that to the ball is larger"},
          self.carryAlong);
  }
};

/// Who walks far from the ball looks along its way now and then: whom it does not see it runs over.
struct GlanceParameters {
  double every = 0.6;
  double length = 0.35;
  double farFromBall = 1.5;
  double farToGo = 0.6;
  double aside = 0.25;
  double nearOpponent = 1.2;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    using namespace config;
    visit({"every", Unit::Second, {0.1, 60}, fixed, "From one glance along the way to the next"}, self.every);
    visit({"length", Unit::Second, {0, 10}, fixed, "How long a glance lasts; 0: none"}, self.length);
    visit({"farFromBall", Unit::Metre, {0, 50}, fixed, "Who is nearer to the ball watches it all the time"},
          self.farFromBall);
    visit({"farToGo", Unit::Metre, {0, 50}, fixed, "Shorter ways need no glance"}, self.farToGo);
    visit({"aside",
           Unit::Radian,
           {0, 3.2},
           fixed,
           "With the way at a smaller angle from the ball both are seen at once"},
          self.aside);
    visit({"nearOpponent",
           Unit::Metre,
           {0, 10},
           fixed,
           "Out of the duel it looks now and then at an opponent that is so near and out of sight"},
          self.nearOpponent);
  }
};

/// Looking for a lost ball (search_ball.cpp).
struct SearchParameters {
  double headFirst = 2.0;
  double afterStart = 3.0;
  double turnSpeed = 0.8;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    using namespace config;
    visit({"headFirst",
           Unit::Second,
           {0, 20},
           fixed,
           "The head alone looks around for this long before the body turns"},
          self.headFirst);
    visit({"afterStart",
           Unit::Second,
           {0, 20},
           fixed,
           "The body does not turn so soon after the play mode changed"},
          self.afterStart);
    visit({"turnSpeed", Unit::RadianPerSecond, {0, 5}, fixed, "Of the body while it searches"},
          self.turnSpeed);
  }
};

/// Who plays which role (role_voting.h).
struct AgreementParameters {
  double voteAge = 1.0;
  double claimAge = 1.0;
  double silentPenalty = 4.0;
  double goneAfter = 3.5;
  double bannedPenalty = 60.0;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    using namespace config;
    visit({"voteAge",
           Unit::Second,
           {0, 10},
           fixed,
           "Votes count for so long: each player speaks every 0.44 s, and one message may get lost"},
          self.voteAge);
    visit({"claimAge",
           Unit::Second,
           {0, 10},
           fixed,
           "The goalie's word that it goes to the ball holds for so long"},
          self.claimAge);
    visit({"silentPenalty",
           Unit::Second,
           {0, 60},
           fixed,
           "Added to the time to the ball of a team mate that says nothing of playing it"},
          self.silentPenalty);
    visit({"goneAfter",
           Unit::Second,
           {0, 60},
           fixed,
           "Who spoke before and was not heard for so long counts as banned: its process may have died"},
          self.goneAfter);
    visit(
        {"bannedPenalty", Unit::Second, {0, 600}, fixed, "Added for the player that must not touch the ball"},
        self.bannedPenalty);
  }
};

/// What is told by radio, and when (radio.h).
struct RadioParameters {
  double oldestBall = 5.0;
  double lostSigma = 3.0;
  bool shareSightings = true;
  double sightingAge = 0.3;
  double toldFor = 1.0;
  int statusBetween = 1;
  double nearBall = 2.0;
  double passLead = 0.5;
  double passAgain = 0.4;
  double absentAfter = 5.0;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    using namespace config;
    visit({"oldestBall", Unit::Second, {0, 5}, fixed, "Older sightings of the ball are not worth the bits"},
          self.oldestBall);
    visit({"lostSigma",
           Unit::Metre,
           {0, 30},
           fixed,
           "Standard deviation that a robot tells of its place when it is lost"},
          self.lostSigma);
    visit({"shareSightings", Unit::None, {}, fixed, "Opponents that one sees are told to the team mates"},
          self.shareSightings);
    visit({"sightingAge", Unit::Second, {0, 1}, fixed, "An opponent is told of if one saw it so lately"},
          self.sightingAge);
    visit({"toldFor",
           Unit::Second,
           {0, 10},
           fixed,
           "An opponent of whom a mate has told is not told of again for so long"},
          self.toldFor);
    visit({"statusBetween",
           Unit::None,
           {0, 100},
           fixed,
           "At least so many messages about oneself and the ball between two about opponents"},
          self.statusBetween);
    visit({"nearBall",
           Unit::Metre,
           {0, 50},
           fixed,
           "Who is nearer to the ball tells of the ball, not of opponents"},
          self.nearBall);
    visit({"passLead",
           Unit::Second,
           {0, 5},
           fixed,
           "A pass is told so long before the kick, in the turn of another if need be"},
          self.passLead);
    visit({"passAgain",
           Unit::Second,
           {0, 5},
           fixed,
           "A pass that was told is told out of turn again only after this time"},
          self.passAgain);
    visit({"absentAfter",
           Unit::Second,
           {0, 60},
           fixed,
           "A number that was silent for so long has no player: its turn is free"},
          self.absentAfter);
  }
};

/// Who took the own set piece and must not touch the ball again (touch_watch.h).
struct TouchParameters {
  double takerReach = 1.2;
  double resting = 0.3;
  double touchReach = 0.24;
  double turnedReach = 0.45;
  double turnedAfter = 0.5;
  double turnedFor = 0.1;
  double longest = 12.0;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    using namespace config;
    visit({"takerReach", Unit::Metre, {0, 5}, fixed, "The taker is this near to the ball when play goes on"},
          self.takerReach);
    visit({"resting",
           Unit::MetrePerSecond,
           {0, 5},
           fixed,
           "The taker of a goal kick is who was so near when the ball was last slower than this"},
          self.resting);
    visit({"touchReach",
           Unit::Metre,
           {0, 2},
           fixed,
           "From torso to ball at a touch: foot, toe and radius of the ball"},
          self.touchReach);
    visit({"turnedReach",
           Unit::Metre,
           {0, 2},
           fixed,
           "From torso to ball at a touch that only shows in the ball's changed way"},
          self.turnedReach);
    visit({"turnedAfter",
           Unit::Second,
           {0, 5},
           fixed,
           "A change of way so soon after the set piece is the taker's own touch"},
          self.turnedAfter);
    visit({"turnedFor", Unit::Second, {0, 2}, fixed, "A change of way counts for so long"}, self.turnedFor);
    visit({"longest",
           Unit::Second,
           {0, 60},
           fixed,
           "The ban ends unseen after this time, since no message of the server tells of it"},
          self.longest);
  }
};

struct TeamParameters {
  FormationParameters formation;
  BallTargetParameters target;
  BallHandlingParameters ball;
  ShotParameters shot;
  AsideParameters aside;
  DribbleParameters dribble;
  ReceiveParameters receive;
  PassParameters pass;
  PassModeParameters passMode;
  ChoiceParameters choice;
  GoalieParameters goalie;
  PaceParameters pace;
  NavigationParameters navigation;
  ChargingParameters charging;
  SetPlayParameters setPlay;
  BeamParameters beam;
  SearchParameters ballSearch;
  GlanceParameters glance;
  AgreementParameters agreement;
  RadioParameters radio;
  TouchParameters touch;
  ChallengeParameters challenge;
  VariantParameters variant;
  double avoidDistance = 0.45;
  double onBallRoom = 0.8;
  double keepBallTime = 1.0;
  double keepBallFar = 0.3;
  double clearOfOpponentKick = 2.3;
  double clearOfGoalKick = 0.8;
  double waitForReceiver = 8.0;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    using namespace config;
    visit.group("formation", self.formation);
    visit.group("target", self.target);
    visit.group("ball", self.ball);
    visit.group("shot", self.shot);
    visit.group("aside", self.aside);
    visit.group("dribble", self.dribble);
    visit.group("receive", self.receive);
    visit.group("pass", self.pass);
    visit.group("passMode", self.passMode);
    visit.group("choice", self.choice);
    visit.group("goalie", self.goalie);
    visit.group("pace", self.pace);
    visit.group("navigation", self.navigation);
    visit.group("charging", self.charging);
    visit.group("setPlay", self.setPlay);
    visit.group("beam", self.beam);
    visit.group("ballSearch", self.ballSearch);
    visit.group("glance", self.glance);
    visit.group("agreement", self.agreement);
    visit.group("radio", self.radio);
    visit.group("touch", self.touch);
    visit.group("challenge", self.challenge);
    visit.group("variant", self.variant);
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
    visit(
        {"keepBallFar",
         Unit::None,
         {0, 1},
         search(0, 1),
         "By this share of that from one that is still far: in full it counts up to a second from the ball"},
        self.keepBallFar);
    visit({"clearOfOpponentKick",
           Unit::Metre,
           {0, 10},
           fixed,
           "Distance from the ball while the opponent takes a kick"},
          self.clearOfOpponentKick);
    visit({"clearOfGoalKick",
           Unit::Metre,
           {0, 5},
           fixed,
           "Distance kept from the opponent's penalty area at its goal kick: server facts 4.7"},
          self.clearOfGoalKick);
    visit({"waitForReceiver",
           Unit::Second,
           {0, 15},
           fixed,
           "Own set piece: longest wait for the receiver before the ball is touched"},
          self.waitForReceiver);
  }
};

}  // namespace nonet::team
