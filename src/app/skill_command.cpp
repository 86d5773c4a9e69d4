// nonet skill check FILES, nonet skill format FILES: the tools of the skill language.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "nonet/app/commands.h"
#include "nonet/motion/skill_language.h"
#include "nonet/motion/skill_library.h"

namespace nonet::app {

namespace {

struct SkillArguments {
  std::vector<std::string> files;
  bool testOnly = false;  // format: write nothing, fail if a file would change
};

std::string readFile(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(fmt::format("{}: cannot be read", path));
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

// A folder stands for the *.skl files in it.
std::vector<std::string> expand(const std::vector<std::string>& arguments) {
  std::vector<std::string> files;
  for (const std::string& argument : arguments) {
    if (std::filesystem::is_directory(argument)) {
      const std::vector<std::string> inside = motion::skillFiles(argument);
      files.insert(files.end(), inside.begin(), inside.end());
    } else {
      files.push_back(argument);
    }
  }
  return files;
}

int check(const SkillArguments& arguments) {
  int wrong = 0;
  std::vector<motion::Skill> all;
  const std::vector<std::string> files = expand(arguments.files);
  for (const std::string& file : files) {
    try {
      for (motion::Skill& skill : motion::parseSkills(readFile(file), file)) all.push_back(std::move(skill));
    } catch (const std::exception& error) {
      fmt::print(stderr, "{}\n", error.what());
      ++wrong;
    }
  }
  if (wrong > 0) return 1;
  // Calls are looked up among the files given and in the folders they come from.
  std::vector<std::string> folders;
  folders.reserve(files.size());
  for (const std::string& file : files) {
    folders.push_back(std::filesystem::path(file).parent_path().string());
  }
  std::sort(folders.begin(), folders.end());
  folders.erase(std::unique(folders.begin(), folders.end()), folders.end());
  const std::size_t given = all.size();
  for (const std::string& folder : folders) {
    for (const std::string& file : motion::skillFiles(folder.empty() ? "." : folder)) {
      const auto same = [&](const std::string& other) { return std::filesystem::equivalent(file, other); };
      if (std::any_of(files.begin(), files.end(), same)) continue;
      for (motion::Skill& skill : motion::parseSkills(readFile(file), file)) all.push_back(std::move(skill));
    }
  }
  const motion::SkillLibrary library(std::move(all));
  fmt::print("{} files, {} skills: no errors\n", files.size(), given);
  return 0;
}

int format(const SkillArguments& arguments) {
  int changed = 0;
  for (const std::string& file : expand(arguments.files)) {
    const std::string before = readFile(file);
    const std::string after = motion::formatSkills(before, file);
    if (after == before) continue;
    ++changed;
    if (arguments.testOnly) {
      fmt::print(stderr, "{}: not formatted (nonet skill format {})\n", file, file);
      continue;
    }
    std::ofstream out(file, std::ios::binary);
    out << after;
    if (!out.flush()) throw std::runtime_error(fmt::format("{}: cannot be written", file));
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
}

}  // namespace nonet::app
