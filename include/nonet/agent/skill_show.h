// Shows one skill instead of playing: again and again, each time from a quiet stand. For trying out a new
// skill on a server, with a viewer.
#pragma once

#include "nonet/motion/motion_state.h"
#include "nonet/motion/request.h"
#include "nonet/world/world_state.h"

namespace nonet::agent {

class SkillShow {
 public:
  explicit SkillShow(const motion::PlaySkill& skill) : skill_(skill) {}

  /// Called once a cycle: the skill, or to stand until it is time for it.
  motion::MotionRequest update(const world::WorldState& world, const motion::MotionState& motion);

  static constexpr double kPause = 2.0;  // s upright and up before the skill begins

 private:
  motion::PlaySkill skill_;
  double stood_ = 0.0;  // s
};

}  // namespace nonet::agent
