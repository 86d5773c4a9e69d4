// All skills of a folder, with calls resolved.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "nonet/motion/skill.h"
#include "nonet/motion/skill_parameters.h"

namespace nonet::motion {

struct SkillText;  // skill_language.h

class SkillLibrary {
 public:
  SkillLibrary() = default;
  /// Reads skillFolder/*.skl in the order of their names. Throws SkillError: a file that does not parse, two
  /// skills of one name, a call of an unknown skill or of itself. A folder that does not exist holds no
  /// skills.
  SkillLibrary(const std::string& skillFolder, const SkillParameters& parameters);
  /// From skills that are parsed already.
  explicit SkillLibrary(std::vector<Skill> skills);

  /// Index of a skill, -1 if there is none of that name.
  int find(std::string_view name) const;
  const Skill& skill(int index) const { return skills_[static_cast<std::size_t>(index)]; }
  std::size_t size() const { return skills_.size(); }

  static constexpr int kDeepestCall = 8;

 private:
  void resolve();
  int depthOf(int index, int depth) const;
  std::vector<Skill> skills_;
};

/// The same as SkillLibrary(skillFolder, parameters), one for all who ask for it with copies of the same
/// parameters: a trial that makes its robots anew in every episode need not read the files again. A file that
/// was changed since the parameters were declared is not read again either. From any thread.
std::shared_ptr<const SkillLibrary> sharedSkillLibrary(const std::string& skillFolder,
                                                       const SkillParameters& parameters);

/// Paths of the *.skl files of a folder, sorted.
std::vector<std::string> skillFiles(const std::string& skillFolder);

/// The folder in which a skill file lies: "." for a bare name.
std::string skillFolderOf(const std::string& file);

/// The files of a folder. Throws SkillError if one cannot be read.
std::vector<SkillText> skillTexts(const std::string& skillFolder);

}  // namespace nonet::motion
