#include <cctype>
#include <cerrno>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "nonet/app/commands.h"
#include "nonet/app/version.h"
#include "nonet/config/nearest.h"

namespace {

// Every wrong command line ends with this, whatever was wrong with it.
constexpr int kWrongUse = 1;
constexpr int kFailed = 1;

void checkCommand(const CLI::App& app, const std::string& given) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands(nullptr)) names.push_back(command->get_name());
  for (const std::string& name : names) {
    if (name == given) return;
  }
  throw std::runtime_error("there is no command '" + given + "': did you mean '" +
                           nonet::config::nearestOf(names, given) + "'? nonet --help lists all");
}

/// Ranges let NaN through, and a seed of -1 would become another one.
std::string checkNumber(const std::string& text) {
  const std::string_view word = text;
  const std::size_t sign = word.starts_with('-') || word.starts_with('+') ? 1 : 0;
  const char first = word.size() > sign ? static_cast<char>(std::tolower(word[sign])) : '0';
  if (first == 'n' || first == 'i') return fmt::format("'{}' is no finite number", text);
  return "";
}
std::string checkCount(const std::string& text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc() && end == text.data() + text.size()) return "";
  return fmt::format("'{}' is no whole number from 0 to 2^64 - 1", text);
}

void finishOptions(CLI::App& command) {
  for (CLI::Option* option : command.get_options()) {
    const std::string type = option->get_type_name();
    if (type.starts_with("FLOAT")) option->check(CLI::Validator(checkNumber, ""));
    if (type.starts_with("UINT")) option->check(CLI::Validator(checkCount, ""));
    if (option->get_default_str() == "[]") option->default_str("");  // for --help: no list, no default
  }
  for (CLI::App* inner : command.get_subcommands(nullptr)) finishOptions(*inner);
}

int run(int argc, char** argv) {
  CLI::App app{"Nonet: a RoboCup 3D soccer agent, its embedded server and its laboratory"};
  app.require_subcommand(1);
  app.option_defaults()->always_capture_default();
  app.set_version_flag("--version", nonet::app::versionText());
  int exitCode = 0;
  nonet::app::addPlayCommand(app, exitCode);
  nonet::app::addServeCommand(app, exitCode);
  nonet::app::addMatchCommand(app, exitCode);
  nonet::app::addSeriesCommand(app, exitCode);
  nonet::app::addTableCommand(app, exitCode);
  nonet::app::addStatisticsCommand(app, exitCode);
  nonet::app::addExplainCommand(app, exitCode);
  nonet::app::addViewCommand(app, exitCode);
  nonet::app::addReportCommand(app, exitCode);
  nonet::app::addReplayCommand(app, exitCode);
  nonet::app::addFidelityCommand(app, exitCode);
  nonet::app::addBenchCommand(app, exitCode);
  nonet::app::addOptimizeCommand(app, exitCode);
  nonet::app::addSkillCommand(app, exitCode);
  nonet::app::addWalkReportCommand(app, exitCode);
  nonet::app::addRiseReportCommand(app, exitCode);
  nonet::app::addKickCommand(app, exitCode);
  nonet::app::addKickReportCommand(app, exitCode);
  nonet::app::addBallReportCommand(app, exitCode);
  nonet::app::addEnvCommand(app, exitCode);
  nonet::app::addSaveReportCommand(app, exitCode);
  nonet::app::addParamsCommand(app, exitCode);
  nonet::app::addSoakCommand(app, exitCode);
  finishOptions(app);
  if (argc > 1 && argv[1][0] != '-') checkCommand(app, argv[1]);
  const std::string_view first = argc > 1 ? argv[1] : "";
  if (first.starts_with('-') && app.get_option_no_throw(std::string(first)) == nullptr)
    throw std::runtime_error(
        fmt::format("there is no option '{}' before a command; nonet --help lists the commands", first));
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kWrongUse;
  }
  return exitCode;
}

void complain(const std::string& what) {
  std::fputs(fmt::format("nonet: {}\n", what).c_str(), stderr);  // throws nothing on a full disk
}

/// What is short waits in a buffer until the end: only now a full disk shows.
int exitCodeAfterOutput(int exitCode) {
  const bool flushed = std::fflush(stdout) == 0;
  if (flushed && std::ferror(stdout) == 0) return exitCode;
  complain(fmt::format("the standard output is not complete, it cannot be written{}",
                       flushed ? "" : fmt::format(": {}", std::strerror(errno))));
  return exitCode == 0 ? kFailed : exitCode;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return exitCodeAfterOutput(run(argc, argv));
  } catch (const std::exception& error) {
    complain(error.what());
    return kFailed;
  }
}
