#include <filesystem>

#include <fmt/format.h>

#include "nonet/app/commands.h"
#include "nonet/app/data_folder.h"
#include "nonet/lab/replay.h"

namespace nonet::app {
namespace {

struct ReplayArguments {
  std::vector<std::string> files;
  lab::ReplayOptions options;
  bool json = false;
};

int runReplay(ReplayArguments& arguments) {
  arguments.options.dataFolder = dataFolder();
  int exitCode = 0;
  for (const std::string& file : arguments.files) {
    try {
      const lab::ReplayReport report = lab::replay(file, arguments.options);
      if (arguments.json) {
        fmt::print("{}\n", report.toJson().dump());
      } else {
        fmt::print("{}", report.toText());
      }
      if (!report.clean()) exitCode = 1;
    } catch (const std::exception& error) {
      fmt::print(stderr, "nonet replay: {}\n", error.what());
      exitCode = 2;
    }
  }
  return exitCode;
}

}  // namespace

void addReplayCommand(CLI::App& app, int& exitCode) {
  CLI::App* command = app.add_subcommand("replay", "Runs the agent over recorded logs");
  auto arguments = std::make_shared<ReplayArguments>();
  command->add_option("files", arguments->files, "Logs: our own, or foreign ones, plain, gzip or zstd")
      ->required();
  command->add_flag("--json", arguments->json, "One JSON object per file and line");
  lab::ReplayOptions& options = arguments->options;
  command->add_option("--unum", options.unum, "Foreign logs: the robot's number, if the log does not tell");
  command->add_option("--team", options.team, "Foreign logs: its team");
  command->add_option("--type", options.robotType, "Foreign logs: its type")->check(CLI::Range(0, 4));
  command
      ->add_option("--params", options.parameterFiles,
                   "Foreign logs: parameter files, overlaid in this order")
      ->check(CLI::ExistingFile);
  command->footer(
      "Our own logs hold their parameters and seed: the answers must come out byte for byte as recorded.\n"
      "Exit codes: 0 all well, 1 a difference or an unknown token, 2 a file cannot be read.");
  command->callback([arguments, &exitCode] { exitCode = runReplay(*arguments); });
}

}  // namespace nonet::app
