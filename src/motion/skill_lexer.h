// Words of the skill language.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "nonet/config/parameters.h"

namespace nonet::motion {

struct SkillToken {
  enum class Kind : std::uint8_t { Word, Number, Symbol, Comment, NewLine, End };
  Kind kind = Kind::End;
  std::string_view text;  // as written
  double value = 0.0;     // Number: in SI units
  config::Unit unit = config::Unit::None;
  std::string_view file;
  int line = 1;
  int column = 1;
  // Words of a skill that is `like` another one and was written out (skill_like.h):
  std::string_view heir;  // the skill that has this word from the one in whose text it stands
  bool restates = false;  // "parameter": its name is that of a parameter of the other one
};

/// All tokens, comments and line ends included, closed by End. Throws SkillError.
/// With `errors` they are put there instead of thrown, and reading goes on.
/// The tokens refer to `text` and `file`.
std::vector<SkillToken> lexSkills(std::string_view text, const std::string& file,
                                  std::vector<std::string>* errors = nullptr);
/// The same without comments and line ends.
std::vector<SkillToken> lexWords(std::string_view text, const std::string& file,
                                 std::vector<std::string>* errors = nullptr);

/// "file:line:column: message", and for which skill the text is read if not for the one that stands there.
std::string errorAt(const SkillToken& token, const std::string& message);
/// Throws SkillError at a token.
[[noreturn]] void failAt(const SkillToken& token, const std::string& message);

}  // namespace nonet::motion
