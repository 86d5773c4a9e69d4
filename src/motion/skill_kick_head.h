// The head of a skill that kicks the ball.
#pragma once

#include "nonet/motion/skill.h"

#include "skill_reader.h"

namespace nonet::motion {

/// Reads what stands behind "kick", in braces. Throws SkillError.
KickHead readKickHead(SkillReader& reader);

}  // namespace nonet::motion
