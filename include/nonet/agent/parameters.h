// All parameters of an agent, one group per stage; files in params/ overlay them.
#pragma once

#include "nonet/motion/parameters.h"
#include "nonet/team/parameters.h"
#include "nonet/world/parameters.h"

namespace nonet::agent {

struct AgentParameters {
  world::WorldParameters world;
  motion::MotionParameters motion;
  team::TeamParameters team;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& visit) {
    visit.group("world", self.world);
    visit.group("motion", self.motion);
    visit.group("team", self.team);
  }
};

}  // namespace nonet::agent
