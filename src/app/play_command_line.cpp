#include "nonet/app/play_command_line.h"

#include <array>
#include <cstdio>
#include <memory>
#include <stdexcept>

#include <fmt/format.h>

#include "nonet/app/data_folder.h"
#include "nonet/app/shell_word.h"

namespace nonet::app {
namespace {

std::string helpOf(const std::string& executable) {
  const std::string line = quoted(executable) + " play --help 2>/dev/null </dev/null";
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(::popen(line.c_str(), "r"), ::pclose);
  std::string text;
  std::array<char, 4096> block{};
  while (pipe != nullptr) {
    const std::size_t size = std::fread(block.data(), 1, block.size(), pipe.get());
    if (size == 0) break;
    text.append(block.data(), size);
  }
  return text;
}

}  // namespace

PlayProgram::PlayProgram() : executable_(executablePath()) {}

PlayProgram::PlayProgram(const std::string& executable) : executable_(executable), help_(helpOf(executable)) {
  for (const char* needed : {"--host", "--port", "--unum", "--team", "--type"}) {
    if (!knows(needed))
      throw std::runtime_error(
          fmt::format("{}: is no executable of Nonet: '{} play --help' does not speak of {}", executable,
                      executable, needed));
  }
}

bool PlayProgram::knows(const std::string& option) const {
  if (help_.empty()) return executable_ == executablePath();
  for (std::size_t at = help_.find(option); at != std::string::npos; at = help_.find(option, at + 1)) {
    const std::size_t end = at + option.size();
    if (end == help_.size() || std::string(" ,\n").find(help_[end]) != std::string::npos) return true;
  }
  return false;
}

std::vector<std::string> playCommand(const PlayProgram& program, const agent::AgentChoice& agent,
                                     const PlayPlace& place) {
  std::vector<std::string> command = {program.executable(), "play"};
  const auto add = [&](const std::string& option, const std::string& value) {
    command.push_back(option);
    command.push_back(value);
  };
  add("--host", place.host);
  add("--port", std::to_string(place.port));
  add("--unum", std::to_string(agent.unum));
  add("--team", agent.team);
  add("--type", std::to_string(agent.robotType));
  for (const std::string& file : agent.parameterFiles) add("--params", file);
  for (const std::string& assignment : agent.assignments) add("--set", assignment);
  if (!place.dataFolder.empty()) add("--data", place.dataFolder);
  if (program.knows("--seed")) add("--seed", std::to_string(agent.seed));
  if (!place.report.empty() && program.knows("--report")) add("--report", place.report);
  // In lock-step nothing but the messages may decide what an agent sends.
  if (place.lockStep && program.knows("--sync")) add("--sync", "on");
  if (place.lockStep && program.knows("--at-once")) command.emplace_back("--at-once");
  return command;
}

}  // namespace nonet::app
