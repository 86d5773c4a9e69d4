// Head control: a head request -> pan and tilt angles, without jumps.
//
// Needs: the measured body. Gives: the two neck joints of the targets. The camera sees 120 x 120 degrees
// (server facts 2.7), so a scan of +-100 degrees covers everything around the robot.
#pragma once

#include "nonet/config/parameters.h"
#include "nonet/motion/request.h"
#include "nonet/world/body_state.h"

namespace nonet::motion {

struct HeadParameters {
  double maxSpeed = 4.0;
  double scanPan = 1.75;
  double scanTilt = 0.2;
  double scanPeriod = 3.0;
  double nearTilt = 0.6;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    using namespace config;
    visit({"maxSpeed", Unit::RadianPerSecond, {0.1, 6.1}, fixed, "Fastest turn of the head"}, self.maxSpeed);
    visit({"scanPan", Unit::Radian, {0.0, 2.09}, fixed, "Largest pan of the search, to either side"},
          self.scanPan);
    visit({"scanTilt", Unit::Radian, {-0.78, 0.78}, fixed, "Tilt of the search, positive = down"},
          self.scanTilt);
    visit({"scanPeriod", Unit::Second, {0.5, 20.0}, fixed, "Time of one search to both sides and back"},
          self.scanPeriod);
    visit({"nearTilt",
           Unit::Radian,
           {0.0, 0.78},
           fixed,
           "Lowest tilt when looking at a point, positive = down"},
          self.nearTilt);
  }
};

class HeadControl {
 public:
  HeadControl(const model::RobotModel& model, const HeadParameters& parameters);

  /// Writes the neck joints of `targets`.
  void update(const world::BodyState& body, const HeadRequest& request, JointTargets& targets);

  /// Starts again from the measured angles (after something else moved the head).
  void release() { active_ = false; }

 private:
  void follow(double pan, double tilt, double time, JointTargets& targets);
  double scanAngle(double time);

  const model::RobotModel* model_;
  HeadParameters parameters_;
  double pan_ = 0.0;        // commanded, rad
  double tilt_ = 0.0;       // commanded, rad, positive = down
  double scanPhase_ = 0.0;  // share of the search period, 0..1
  bool scanning_ = false;
  bool active_ = false;
};

}  // namespace nonet::motion
