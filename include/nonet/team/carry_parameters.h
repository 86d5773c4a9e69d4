// Declared parameters of dribbling and receiving (behaviors/dribble.cpp, behaviors/receive.cpp).
#pragma once

#include "nonet/config/parameters.h"

namespace nonet::team {

/// Running after the ball so that the feet push it on along its line.
struct DribbleParameters {
  bool steer = false;
  double speed = 1.2;
  double touch = 0.3;
  double haste = 2.0;
  double loose = 1.0;
  double leastSpeed = 0.15;
  double asideSpeed = 0.4;
  double asideGain = 5.0;
  double turnGain = 3.0;
  double contact = 0.10;
  double tolerance = 0.02;
  double footAside = 0.045;
  double toe = 0.1;
  double lead = 0.1;
  double angle = 0.7;
  double aside = 0.12;
  double cone = 0.5;
  double behind = 0.04;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    using namespace config;
    visit({"steer",
           Unit::None,
           {0, 1},
           fixed,
           "Whether to keep the ball at the feet in games too, steered to its line; otherwise the robot runs "
           "through it"},
          self.steer);
    visit({"speed", Unit::MetrePerSecond, {0.1, 3}, search(0.4, 2.0), "Of the robot behind a ball in line"},
          self.speed);
    visit({"touch",
           Unit::MetrePerSecond,
           {0, 3},
           search(0.1, 0.8),
           "Of the robot when it meets the ball: a foot in its swing is more than twice as fast"},
          self.touch);
    visit({"haste",
           Unit::Hertz,
           {0, 50},
           search(0.5, 5),
           "Speed more per distance that is left to the contact"},
          self.haste);
    visit({"loose",
           Unit::None,
           {0, 10},
           search(0.0, 4.0),
           "Touch and haste grow by this share of the share by which the ball may be farther from the torso "
           "than 0.5 m"},
          self.loose);
    visit({"leastSpeed",
           Unit::MetrePerSecond,
           {0, 3},
           search(0.0, 0.8),
           "Ahead, however far the ball is beside the line"},
          self.leastSpeed);
    visit({"asideSpeed",
           Unit::MetrePerSecond,
           {0.05, 3},
           search(0.1, 1.0),
           "Sideways; ahead the robot is as fast as leaves time to be in line at the contact"},
          self.asideSpeed);
    visit({"asideGain", Unit::Hertz, {0.1, 50}, search(1, 15), "Speed sideways per distance beside the line"},
          self.asideGain);
    visit({"turnGain", Unit::Hertz, {0, 50}, search(0.5, 8), "Turning speed per angle to the direction"},
          self.turnGain);
    visit({"contact",
           Unit::Metre,
           {0, 0.5},
           search(0.0, 0.25),
           "From the torso to the ball when the foot meets it"},
          self.contact);
    visit({"tolerance",
           Unit::Metre,
           {0, 0.3},
           search(0.0, 0.1),
           "A ball that lies this little beside the line is in line"},
          self.tolerance);
    visit({"footAside",
           Unit::Metre,
           {0, 0.2},
           search(0.0, 0.08),
           "The ball is met this far beside the middle, by the foot on whose side it is"},
          self.footAside);
    visit({"toe",
           Unit::Radian,
           {-0.5, 0.5},
           search(0.0, 0.3),
           "The robot faces so far inwards of the direction, since a foot whose toes point outwards sends "
           "the ball there"},
          self.toe);
    visit({"lead", Unit::Second, {0, 0.5}, search(0.0, 0.2), "The ball is met where it will be after this"},
          self.lead);
    visit({"angle",
           Unit::Radian,
           {0, 3.2},
           search(0.2, 1.5),
           "Dribble when the ball is to go this little aside of where the robot faces"},
          self.angle);
    visit({"aside",
           Unit::Metre,
           {0, 1},
           search(0.05, 0.3),
           "Dribble when the ball lies this near to the line, and cone"},
          self.aside);
    visit({"cone",
           Unit::None,
           {0, 5},
           search(0.0, 2.0),
           "Dribble when the ball lies farther from the line by this share of its distance ahead"},
          self.cone);
    visit({"behind", Unit::Metre, {0, 1}, search(0.0, 0.15), "Dribble when this far behind the ball"},
          self.behind);
  }
};

/// Stopping a ball that rolls to the robot.
struct ReceiveParameters {
  bool use = true;
  double speed = 0.4;
  double within = 3.0;
  double pace = 0.5;
  double reaction = 0.15;
  double reach = 0.25;
  double nearest = 0.35;
  double step = 0.1;
  double ready = 0.03;
  double gain = 4.0;
  double cushion = 0.0;
  double cushionTime = 0.3;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    using namespace config;
    visit({"use", Unit::None, {0, 1}, fixed, "Whether to go to the line of a ball that comes, and stop it"},
          self.use);
    visit({"speed",
           Unit::MetrePerSecond,
           {0, 10},
           search(0.2, 1.0),
           "A ball that comes slower is gone to instead"},
          self.speed);
    visit({"nearest", Unit::Metre, {0, 3}, fixed, "One that is nearer is at the feet already"}, self.nearest);
    visit({"within", Unit::Second, {0.1, 10}, fixed, "The ball must be here within this time"}, self.within);
    visit({"pace",
           Unit::MetrePerSecond,
           {0.05, 3},
           search(0.2, 1.0),
           "Speed of the robot on its way to the line, for whether it is there before the ball"},
          self.pace);
    visit({"reaction", Unit::Second, {0, 2}, fixed, "Time that the robot needs besides"}, self.reaction);
    visit({"reach",
           Unit::Metre,
           {0, 1},
           search(0.05, 0.4),
           "Farther beside its place when the ball comes, the robot looks for a later one"},
          self.reach);
    visit({"step", Unit::Second, {0.02, 1}, fixed, "Places on the ball's way are compared this far apart"},
          self.step);
    visit({"ready",
           Unit::Metre,
           {0, 0.3},
           search(0.0, 0.08),
           "This near to its place the robot stands and lets the ball come"},
          self.ready);
    visit(
        {"gain", Unit::Hertz, {0.1, 20}, search(1, 10), "Speed per distance on the last steps to the place"},
        self.gain);
    visit({"cushion",
           Unit::None,
           {0, 2},
           search(0.0, 1.0),
           "The robot steps back before the ball with this share of its speed"},
          self.cushion);
    visit({"cushionTime",
           Unit::Second,
           {0, 2},
           search(0.0, 0.6),
           "The step back before the ball (cushion) begins this long before it is here"},
          self.cushionTime);
  }
};

}  // namespace nonet::team
