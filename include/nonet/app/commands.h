// The subcommands of `nonet`, one file each. Every add...Command() declares its options on a CLI11 subcommand
// and stores the exit code in `exitCode` when it was chosen.
#pragma once

#include <CLI/CLI.hpp>

namespace nonet::app {

void addPlayCommand(CLI::App& app, int& exitCode);
void addServeCommand(CLI::App& app, int& exitCode);
void addMatchCommand(CLI::App& app, int& exitCode);
void addSeriesCommand(CLI::App& app, int& exitCode);
void addTableCommand(CLI::App& app, int& exitCode);
void addStatisticsCommand(CLI::App& app, int& exitCode);
void addExplainCommand(CLI::App& app, int& exitCode);
void addViewCommand(CLI::App& app, int& exitCode);
void addReportCommand(CLI::App& app, int& exitCode);
void addReplayCommand(CLI::App& app, int& exitCode);
void addFidelityCommand(CLI::App& app, int& exitCode);
void addBenchCommand(CLI::App& app, int& exitCode);
void addOptimizeCommand(CLI::App& app, int& exitCode);
void addSkillCommand(CLI::App& app, int& exitCode);
/// nonet skill play, a command of its own in size.
void addSkillPlayCommand(CLI::App& skillCommand, int& exitCode);
void addWalkReportCommand(CLI::App& app, int& exitCode);
void addRiseReportCommand(CLI::App& app, int& exitCode);
void addKickCommand(CLI::App& app, int& exitCode);
void addKickReportCommand(CLI::App& app, int& exitCode);
void addBallReportCommand(CLI::App& app, int& exitCode);
void addEnvCommand(CLI::App& app, int& exitCode);
void addSaveReportCommand(CLI::App& app, int& exitCode);
void addParamsCommand(CLI::App& app, int& exitCode);
void addSoakCommand(CLI::App& app, int& exitCode);

}  // namespace nonet::app
