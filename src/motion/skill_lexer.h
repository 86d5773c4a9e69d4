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
  int line = 1;
  int column = 1;
};

/// All tokens, comments and line ends included, closed by End. Throws SkillError.
/// With `errors` they are put there instead of thrown, and reading goes on.
std::vector<SkillToken> lexSkills(std::string_view text, const std::string& file,
                                  std::vector<std::string>* errors = nullptr);

/// "file:line:column: message".
std::string errorAt(const std::string& file, const SkillToken& token, const std::string& message);
/// Throws SkillError at a token.
[[noreturn]] void failAt(const std::string& file, const SkillToken& token, const std::string& message);

}  // namespace nonet::motion
