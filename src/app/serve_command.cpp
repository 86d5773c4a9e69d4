#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "nonet/app/commands.h"
#include "nonet/app/option_checks.h"
#include "nonet/app/team_name.h"
#include "nonet/sim/server/server.h"

namespace nonet::app {

namespace {

struct ServeArguments {
  sim::ServerSettings server;
  std::uint64_t seed = 1;
  std::string field = "30x20";
  std::vector<std::string> files;
  std::vector<std::string> assignments;
  std::string leftTeam;
  std::string rightTeam;
  bool realTime = false;
  bool sync = false;
  bool freeRun = false;
  bool truth = false;
  bool noNoise = false;
  bool listSettings = false;
  bool verbose = false;
  std::string solver = "exact";
};

constexpr const char* kExamples = R"(Examples:
  nonet serve                                    real time, ports 3100 and 3200, as the league's server
  nonet serve --bind 0.0.0.0                     the same for agents on other machines
  nonet serve --sync --players 18 --left Nonet   a reproducible match in lock-step
  nonet serve --sync --truth --no-noise          for experiments with one robot
  nonet serve --set RuleHalfTime=60 --set AutomaticKickOff=true
  nonet serve --settings match.toml              lines like: RuleHalfTime = 60
Exit codes: 0 ended as asked, 1 an error, or the file of --record-monitor is not whole.)";

sim::Settings settingsFrom(const ServeArguments& arguments) {
  sim::Settings settings;
  settings.setField(arguments.field);
  for (const std::string& file : arguments.files) settings.overlayFile(file);
  if (arguments.truth) settings.senseTruth();
  if (arguments.noNoise) settings.removeNoise();
  for (const std::string& name : {arguments.leftTeam, arguments.rightTeam})
    if (!name.empty()) checkTeamName(name);
  if (!arguments.leftTeam.empty() && arguments.leftTeam == arguments.rightTeam)
    throw std::runtime_error("--left and --right must be different names");
  if (!arguments.leftTeam.empty()) settings.leftTeam = arguments.leftTeam;
  if (!arguments.rightTeam.empty()) settings.rightTeam = arguments.rightTeam;
  if (arguments.solver == "quick") settings.quickSolver = true;
  for (const std::string& assignment : arguments.assignments) settings.setAssignment(assignment);
  return settings;
}

int runServe(ServeArguments& arguments) {
  const sim::Settings settings = settingsFrom(arguments);
  if (arguments.listSettings) {
    for (const config::ParameterView& setting : sim::listSettings(settings)) {
      fmt::print("{:32} {:>18} {:4} {}\n", setting.key, setting.text,
                 config::unitName(setting.declaration.unit), setting.declaration.text);
    }
    return 0;
  }
  if (arguments.verbose) spdlog::set_level(spdlog::level::debug);
  arguments.server.lockStep = arguments.sync;
  arguments.server.realTime = arguments.realTime || (!arguments.sync && !arguments.freeRun);
  arguments.server.handleSignals = true;
  sim::Server server(settings, arguments.seed, arguments.server);
  spdlog::info("server: agents on port {}, monitors on port {} of {}, {}{}, seed {}", server.agentPort(),
               server.monitorPort(), arguments.server.address, arguments.sync ? "lock-step" : "no lock-step",
               arguments.server.realTime ? " in real time" : "", arguments.seed);
  if (arguments.server.address.starts_with("127.")) {
    spdlog::info("server: other machines cannot reach it; --bind 0.0.0.0 lets them");
  } else {
    spdlog::warn("server: whoever reaches port {} is obeyed as a trainer", server.monitorPort());
  }
  server.run();
  const sim::MatchState& match = server.simulation().match();
  spdlog::info("server: ended at {:.2f} s of the game, {} {} : {} {}", match.time,
               match.teamLeft.empty() ? "left" : std::string_view(match.teamLeft), match.scoreLeft,
               match.scoreRight, match.teamRight.empty() ? "right" : std::string_view(match.teamRight));
  return server.recordingError().empty() ? 0 : 1;
}

}  // namespace

void addServeCommand(CLI::App& app, int& exitCode) {
  CLI::App* command = app.add_subcommand("serve", "The embedded server, on the network");
  auto arguments = std::make_shared<ServeArguments>();
  ServeArguments& a = *arguments;
  command->footer(kExamples);
  command->add_option("--port", a.server.agentPort, "Port for agents, 0: any free one")->check(ownPort());
  command
      ->add_option("--monitor-port", a.server.monitorPort, "Port for monitors and trainers, 0: any free one")
      ->check(ownPort());
  command->add_option("--bind", a.server.address,
                      "Address to listen on; 0.0.0.0: all, so that others can connect");
  command->add_option("--most-connections", a.server.mostConnections, "Of agents, and of monitors, at once")
      ->check(CLI::Range(1, 1000));
  command->add_option("--most-per-address", a.server.mostPerAddress, "Of these from one address")
      ->check(CLI::Range(1, 1000));
  command->add_option("--seed", a.seed, "Seed of all noise and of the referee's random choices");
  auto* realTime =
      command->add_flag("--realtime", a.realTime,
                        "20 ms per cycle (the default, unless --sync or --free is given); with --sync: "
                        "lock-step, but never faster than the clock");
  command->add_flag("--sync", a.sync, "Lock-step: each cycle waits for the (syn) of every agent");
  command->add_flag("--free", a.freeRun, "As fast as possible, waiting for nobody")->excludes(realTime);
  command
      ->add_option("--answer-timeout", a.server.answerTimeout,
                   "Lock-step: seconds after which an agent that does not answer is no longer waited for")
      ->check(moreThanZero());
  command
      ->add_option(
          "--players", a.server.players,
          "Start when so many agents are there; they enter in the order of team and number, so that a "
          "lock-step match with the same seed is the same again")
      ->check(CLI::Range(0, 22));
  command->add_option("--left", a.leftTeam, "Name of the team that plays left (else the first to come)");
  command->add_option("--right", a.rightTeam, "Name of the team that plays right");
  command->add_option("--field", a.field, "Size of the field: 30x20 or 21x14");
  command->add_option("--settings", a.files, "TOML files with settings of the server, overlaid in this order")
      ->check(CLI::ExistingFile);
  command->add_option("--set", a.assignments, "One setting, Name=Value; see --list-settings");
  command->add_flag("--list-settings", a.listSettings, "Print all settings with their values and end");
  command->add_flag("--truth", a.truth, "Agents are told mypos, myorien and ballpos");
  command->add_flag("--no-noise", a.noNoise, "No noise of vision and beams");
  command->add_option("--solver", a.solver, "Physics: exact, as the league's server, or quick")
      ->check(CLI::IsMember({"exact", "quick"}));
  command->add_option(
      "--record-monitor", a.server.monitorLog,
      "Write the monitor stream into this file (sparkmonitor.log format; compressed with zstd unless "
      "its name ends in .log)");
  command->add_flag("--end-with-match", a.server.endWithMatch, "End after the match");
  command->add_flag("-v,--verbose", a.verbose, "Say more");
  command->callback([arguments, &exitCode] { exitCode = runServe(*arguments); });
}

}  // namespace nonet::app
