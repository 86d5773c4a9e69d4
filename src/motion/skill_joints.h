// Joints as the skill language names them.
#pragma once

#include <vector>

#include "nonet/motion/skill.h"

#include "skill_reader.h"

namespace nonet::motion {

/// Reads "left.knee -30deg" and adds one goal, or with "both" two; without an angle the joints are only
/// named. Throws SkillError.
void readJoints(SkillReader& reader, std::vector<JointGoal>& goals, bool withAngle);

}  // namespace nonet::motion
