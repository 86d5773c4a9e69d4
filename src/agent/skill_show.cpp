#include "nonet/agent/skill_show.h"

namespace nonet::agent {

motion::MotionRequest SkillShow::update(const world::WorldState& world, const motion::MotionState& motion) {
  const bool stands = world.body.posture == world::Posture::Upright && !motion.rising && !motion.busy &&
                      !motion.skillFinished && !motion.beam;
  stood_ = stands ? stood_ + world.body.cycleTime : 0.0;
  // Who stops asking when it runs would have it played once more.
  if (motion.busy || stood_ > kPause) return skill_;
  return motion::Stand{};
}

}  // namespace nonet::agent
