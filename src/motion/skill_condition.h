// Conditions of the skill language: "upright and not (time > 2s)".
#pragma once

#include <vector>

#include "nonet/motion/skill.h"

#include "skill_reader.h"

namespace nonet::motion {

/// Reads a condition, adds its nodes to `nodes` and gives the index of the topmost one. Throws SkillError.
int readCondition(SkillReader& reader, std::vector<ConditionNode>& nodes);

}  // namespace nonet::motion
