// "skill a like b { ... }": a skill with the statements of another one.
#pragma once

#include <string>
#include <vector>

#include "nonet/motion/skill_language.h"

#include "skill_lexer.h"

namespace nonet::motion {

/// The words of a file (lexWords()) with every skill that is `like` another one written out in full: the
/// other one's parameters, each followed by what restates it, then its own ones, the head of the kick and the
/// other one's statements. The other skill stands in the same file or in one of `others`. Throws SkillError,
/// or puts the errors into `errors`; such a skill keeps its own parameters only. The result refers to the
/// texts.
std::vector<SkillToken> writeOutLikes(const std::vector<SkillToken>& words, const std::string& file,
                                      const std::vector<SkillText>& others,
                                      std::vector<std::string>* errors = nullptr);

}  // namespace nonet::motion
