// nonet skill check FILES, nonet skill format FILES: the tools of the skill language.
#include <algorithm>
#include <filesystem>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "nonet/app/commands.h"
#include "nonet/config/toml.h"
#include "nonet/lab/common/atomic_file.h"
#include "nonet/motion/skill_language.h"
#include "nonet/motion/skill_library.h"

namespace nonet::app {

namespace {

struct SkillArguments {
  std::vector<std::string> files;
  bool testOnly = false;  // format: write nothing, fail if a file would change
};

std::string readSkills(const std::string& path) {
  return config::readText(path, "skill file");
}

// A folder stands for the *.skl files in it.
std::vector<std::string> expand(const std::vector<std::string>& arguments) {
  std::vector<std::string> files;
  for (const std::string& argument : arguments) {
    if (std::filesystem::is_directory(argument)) {
      const std::vector<std::string> inside = motion::skillFiles(argument);
      if (inside.empty()) throw std::runtime_error(fmt::format("{}: holds no *.skl file", argument));
      files.insert(files.end(), inside.begin(), inside.end());
    } else {
      files.push_back(argument);
    }
  }
  return files;
}

/// The check of a file, beside which stand skills that those in it may be like.
motion::SkillCheck checkFile(const std::string& file) {
  return motion::checkSkills(readSkills(file), file, motion::skillTexts(motion::skillFolderOf(file)));
}

/// Skills of the files beside `files`, for calls into them. Those that make no sense are not this check's
/// business: it says that they were not read.
std::vector<motion::Skill> neighboursOf(const std::vector<std::string>& files) {
  std::set<std::string> folders;
  for (const std::string& file : files) folders.insert(motion::skillFolderOf(file));
  std::vector<motion::Skill> skills;
  for (const std::string& folder : folders) {
    for (const std::string& file : motion::skillFiles(folder)) {
      const auto same = [&](const std::string& other) { return std::filesystem::equivalent(file, other); };
      if (std::any_of(files.begin(), files.end(), same)) continue;
      motion::SkillCheck neighbour = checkFile(file);
      if (!neighbour.errors.empty()) {
        fmt::print(stderr, "{}: has errors of its own ({}), is not checked here\n", file,
                   neighbour.errors.size());
      }
      for (motion::Skill& skill : neighbour.skills) skills.push_back(std::move(skill));
    }
  }
  return skills;
}

/// Calls of skills that are not among `all`, one line each.
std::vector<std::string> missingCalls(const std::vector<motion::Skill>& given,
                                      const std::vector<motion::Skill>& all) {
  std::set<std::string> names;
  for (const motion::Skill& skill : all) names.insert(skill.name);
  std::vector<std::string> errors;
  for (const motion::Skill& skill : given) {
    for (const motion::Instruction& instruction : skill.program) {
      if (instruction.kind != motion::Instruction::Kind::Call || names.contains(instruction.calleeName))
        continue;
      errors.push_back(fmt::format("{}:{}:{}: there is no skill '{}'", skill.textFile, instruction.line,
                                   instruction.column, instruction.calleeName));
    }
  }
  return errors;
}

/// Each once: skills that are like a broken one have its errors too.
std::vector<std::string> withoutRepetitions(const std::vector<std::string>& errors) {
  std::set<std::string> told;
  for (const std::string& error : errors) told.insert(error);
  std::vector<std::string> result;
  for (const std::string& error : errors) {
    const std::size_t heir = error.rfind(" (in ");
    if (heir != std::string::npos && told.contains(error.substr(0, heir))) continue;
    if (told.erase(error) > 0) result.push_back(error);
  }
  return result;
}

int check(const SkillArguments& arguments) {
  std::vector<motion::Skill> given;
  std::vector<std::string> errors;
  const std::vector<std::string> files = expand(arguments.files);
  for (const std::string& file : files) {
    motion::SkillCheck one = checkFile(file);
    errors.insert(errors.end(), one.errors.begin(), one.errors.end());
    for (motion::Skill& skill : one.skills) given.push_back(std::move(skill));
  }
  std::vector<motion::Skill> all = neighboursOf(files);
  all.insert(all.end(), given.begin(), given.end());
  for (std::string& error : missingCalls(given, all)) errors.push_back(std::move(error));
  if (errors.empty()) {
    try {
      const motion::SkillLibrary library(std::move(all));  // names twice, calls in a circle
    } catch (const motion::SkillError& error) {
      errors.emplace_back(error.what());
    }
  }
  errors = withoutRepetitions(errors);
  for (const std::string& error : errors) fmt::print(stderr, "{}\n", error);
  if (!errors.empty()) {
    fmt::print(stderr, "{} files, {} errors\n", files.size(), errors.size());
    return 1;
  }
  fmt::print("{} files, {} skills: no errors\n", files.size(), given.size());
  return 0;
}

int format(const SkillArguments& arguments) {
  int changed = 0;
  for (const std::string& file : expand(arguments.files)) {
    const std::string before = readSkills(file);
    const std::string after =
        motion::formatSkills(before, file, motion::skillTexts(motion::skillFolderOf(file)));
    if (after == before) continue;
    ++changed;
    if (arguments.testOnly) {
      fmt::print(stderr, "{}: not formatted (nonet skill format {})\n", file, file);
      continue;
    }
    lab::writeAtomically(file, after);
    fmt::print("{}: formatted\n", file);
  }
  return arguments.testOnly && changed > 0 ? 1 : 0;
}

}  // namespace

void addSkillCommand(CLI::App& app, int& exitCode) {
  CLI::App* command = app.add_subcommand("skill", "Tools for skill files (skills/README.md)");
  command->require_subcommand(1);
  const auto arguments = std::make_shared<SkillArguments>();
  CLI::App* checkCommand =
      command->add_subcommand("check", "Read skill files and report errors with line and column");
  checkCommand->add_option("files", arguments->files, "*.skl files or folders of them")->required();
  checkCommand->callback([arguments, &exitCode] { exitCode = check(*arguments); });
  CLI::App* formatCommand = command->add_subcommand(
      "format", "Rewrite skill files with normal indentation and spacing, comments kept");
  formatCommand->add_option("files", arguments->files, "*.skl files or folders of them")->required();
  formatCommand->add_flag("--check", arguments->testOnly,
                          "Write nothing; exit code 1 if a file would change");
  formatCommand->callback([arguments, &exitCode] { exitCode = format(*arguments); });
  command->footer(
      "Examples:\n  nonet skill check skills\n  nonet skill format --check skills\n"
      "  nonet skill play dive --type 0 --plot dive.svg");
  addSkillPlayCommand(*command, exitCode);
}

}  // namespace nonet::app
