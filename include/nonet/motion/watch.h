// Where to look: keeps the ball in view, looks where it will be, searches it when it is lost, and glances
// around when the robot has not seen a landmark for a while.
//
// Needs: the world state. Gives: a head request for HeadControl.
#pragma once

#include "nonet/config/parameters.h"
#include "nonet/motion/request.h"
#include "nonet/world/world_state.h"

namespace nonet::motion {

struct WatchParameters {
  double lookAhead = 0.15;
  double lostAfter = 0.8;
  double nearSearch = 1.0;
  double glanceAfter = 1.5;
  double glanceTime = 0.5;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    using namespace config;
    visit({"lookAhead", Unit::Second, {0.0, 2.0}, fixed, "Look where the ball will be after this time"},
          self.lookAhead);
    visit({"lostAfter", Unit::Second, {0.1, 10.0}, fixed, "The ball counts as lost when unseen for so long"},
          self.lostAfter);
    visit({"nearSearch",
           Unit::Second,
           {0.0, 10.0},
           fixed,
           "Then so long search towards where it should be, before searching everywhere"},
          self.nearSearch);
    visit({"glanceAfter",
           Unit::Second,
           {0.1, 100.0},
           fixed,
           "Without a landmark for so long, leave the ball for a glance around"},
          self.glanceAfter);
    visit({"glanceTime", Unit::Second, {0.0, 5.0}, fixed, "Longest glance"}, self.glanceTime);
  }
};

class Watch {
 public:
  explicit Watch(const WatchParameters& parameters = {}) : parameters_(parameters) {}

  HeadRequest update(const world::WorldState& world);

 private:
  WatchParameters parameters_;
  double glanceUntil_ = world::kNever;  // server time, s
  double lastGlance_ = world::kNever;   // server time at which the last one began, s
};

}  // namespace nonet::motion
