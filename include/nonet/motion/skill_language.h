// The skill language: text -> skills, and a formatter that keeps comments. Grammar: skills/README.md.
#pragma once

#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "nonet/motion/skill.h"

namespace nonet::motion {

/// "file:line:column: what is wrong".
class SkillError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Gives the value that replaces a parameter's default, if there is one.
using ParameterLookup =
    std::function<std::optional<double>(std::string_view skill, std::string_view parameter)>;

/// A skill file that was read.
struct SkillText {
  std::string file;
  std::string text;
};

/// Parses one file. Throws SkillError. Calls are not resolved (the library does that). Skills of `others`,
/// the files of the same folder, are found by those that are `like` them.
std::vector<Skill> parseSkills(std::string_view text, const std::string& file,
                               const ParameterLookup& lookup = nullptr,
                               const std::vector<SkillText>& others = {});

/// What parseSkills() would give, and everything that is wrong: an error in one part of a list (a skill, a
/// parameter, a statement, a target) does not hide those in the next. Targets of joints outside the limits of
/// all robot types are errors here. Throws nothing.
struct SkillCheck {
  std::vector<Skill> skills;  // as far as they could be read
  /// "file:line:column: what is wrong", lexical ones and those of `like` first.
  std::vector<std::string> errors;
};
SkillCheck checkSkills(std::string_view text, const std::string& file,
                       const std::vector<SkillText>& others = {});

/// The same text with normal indentation and spacing; line breaks and comments stay. Throws SkillError if the
/// text does not parse. Formatting twice gives the same as once.
std::string formatSkills(std::string_view text, const std::string& file,
                         const std::vector<SkillText>& others = {});

/// A joint by the language's name ("left.knee", "head.tilt"), and whether the language counts its angle the
/// other way round than the server does: `right.shoulderYaw 30deg` is the mirror image of the left one's.
std::string jointWord(model::JointId joint);
bool countsBackwards(model::JointId joint);

}  // namespace nonet::motion
