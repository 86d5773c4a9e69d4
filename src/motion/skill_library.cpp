#include "nonet/motion/skill_library.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <mutex>
#include <stdexcept>

#include <fmt/format.h>

#include "nonet/config/toml.h"
#include "nonet/motion/skill_language.h"

namespace nonet::motion {

namespace {

[[noreturn]] void failIn(const Skill& skill, const Instruction& at, const std::string& message) {
  throw SkillError(fmt::format("{}:{}:{}: {}", skill.textFile, at.line, at.column, message));
}

std::vector<Skill> readFolder(const std::string& folder, const SkillParameters& parameters) {
  std::vector<Skill> skills;
  // Files ask in the order in which they have declared, so the next one is nearly always that after the last.
  std::size_t next = 0;
  const auto lookup = [&](std::string_view skill, std::string_view parameter) {
    const std::size_t at = parameters.indexOf(skill, parameter, next);
    if (at == parameters.values.size()) return std::optional<double>();
    next = at + 1;
    return std::optional(parameters.values[at]);
  };
  const std::vector<SkillText> texts = skillTexts(folder);
  for (const SkillText& text : texts) {
    for (Skill& skill : parseSkills(text.text, text.file, lookup, texts)) skills.push_back(std::move(skill));
  }
  return skills;
}

/// The libraries that were asked for last.
class LibraryShelf {
 public:
  std::shared_ptr<const SkillLibrary> find(const std::string& folder, const SkillParameters& parameters) {
    const std::lock_guard lock(mutex_);
    for (const Book& book : books_) {
      // Names that are the same object stand for the same declaration: the book keeps its own from going
      // away.
      const bool same = book.parameters.names == parameters.names &&
                        book.parameters.values == parameters.values && book.folder == folder;
      if (same) return book.library;
    }
    return nullptr;
  }

  void keep(const std::string& folder, const SkillParameters& parameters,
            std::shared_ptr<const SkillLibrary> library) {
    const std::lock_guard lock(mutex_);
    books_[next_] = {folder, parameters, std::move(library)};
    next_ = (next_ + 1) % books_.size();
  }

 private:
  struct Book {
    std::string folder;
    SkillParameters parameters;
    std::shared_ptr<const SkillLibrary> library;
  };
  std::mutex mutex_;
  std::array<Book, 10> books_;  // two sides of five robot types
  std::size_t next_ = 0;
};

// Outside a declared range nothing breaks, but neither does a file mean it.
constexpr double kAnything = 1e3;

}  // namespace

std::vector<std::string> skillFiles(const std::string& skillFolder) {
  std::vector<std::string> paths;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(skillFolder, error)) {
    if (entry.path().extension() == ".skl") paths.push_back(entry.path().string());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

std::string skillFolderOf(const std::string& file) {
  const std::string folder = std::filesystem::path(file).parent_path().string();
  return folder.empty() ? "." : folder;
}

std::vector<SkillText> skillTexts(const std::string& skillFolder) {
  std::vector<SkillText> texts;
  try {
    for (const std::string& path : skillFiles(skillFolder))
      texts.push_back({path, config::readText(path, "skill file")});
  } catch (const std::runtime_error& error) {
    throw SkillError(error.what());
  }
  return texts;
}

std::size_t SkillParameters::indexOf(std::string_view skill, std::string_view parameter,
                                     std::size_t first) const {
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t at = (first + i) % values.size();
    if ((*names)[at].parameter == parameter && (*names)[at].skill == skill) return at;
  }
  return values.size();
}

std::optional<double> SkillParameters::find(std::string_view skill, std::string_view parameter) const {
  const std::size_t at = indexOf(skill, parameter);
  return at < values.size() ? std::optional(values[at]) : std::nullopt;
}

SkillParameters declareSkillParameters(const std::string& skillFolder) {
  SkillParameters result;
  std::vector<SkillParameters::Name> names;
  for (const Skill& skill : readFolder(skillFolder, result)) {
    for (const SkillParameter& parameter : skill.parameters) {
      const config::Range range = parameter.range.value_or(config::Range{-kAnything, kAnything});
      names.push_back({skill.name, parameter.name, parameter.unit, range, parameter.range});
      result.values.push_back(parameter.value);
    }
  }
  result.names = std::make_shared<const std::vector<SkillParameters::Name>>(std::move(names));
  return result;
}

std::shared_ptr<const SkillLibrary> sharedSkillLibrary(const std::string& skillFolder,
                                                       const SkillParameters& parameters) {
  static LibraryShelf shelf;
  std::shared_ptr<const SkillLibrary> library = shelf.find(skillFolder, parameters);
  if (library) return library;
  library = std::make_shared<const SkillLibrary>(skillFolder, parameters);
  shelf.keep(skillFolder, parameters, library);
  return library;
}

SkillLibrary::SkillLibrary(const std::string& skillFolder, const SkillParameters& parameters)
    : SkillLibrary(readFolder(skillFolder, parameters)) {}

SkillLibrary::SkillLibrary(std::vector<Skill> skills) : skills_(std::move(skills)) {
  resolve();
}

int SkillLibrary::find(std::string_view name) const {
  for (std::size_t i = 0; i < skills_.size(); ++i) {
    if (skills_[i].name == name) return static_cast<int>(i);
  }
  return -1;
}

void SkillLibrary::resolve() {
  for (std::size_t i = 0; i < skills_.size(); ++i) {
    Skill& skill = skills_[i];
    if (find(skill.name) != static_cast<int>(i)) {
      throw SkillError(fmt::format("{}: there is another skill named '{}' in {}", skill.file, skill.name,
                                   skills_[static_cast<std::size_t>(find(skill.name))].file));
    }
    for (Instruction& instruction : skill.program) {
      if (instruction.kind != Instruction::Kind::Call) continue;
      instruction.callee = find(instruction.calleeName);
      if (instruction.callee < 0) {
        failIn(skill, instruction, fmt::format("there is no skill '{}'", instruction.calleeName));
      }
    }
  }
  for (std::size_t i = 0; i < skills_.size(); ++i) depthOf(static_cast<int>(i), 1);
}

// Also finds circles: they have no end.
int SkillLibrary::depthOf(int index, int depth) const {
  int deepest = depth;
  for (const Instruction& instruction : skill(index).program) {
    if (instruction.kind != Instruction::Kind::Call) continue;
    if (depth >= kDeepestCall) {
      failIn(skill(index), instruction, "calls are nested too deeply, or a skill calls itself");
    }
    deepest = std::max(deepest, depthOf(instruction.callee, depth + 1));
  }
  return deepest;
}

}  // namespace nonet::motion
