#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <set>
#include <thread>

#include <fmt/format.h>

#include "nonet/agent/agent_setup.h"
#include "nonet/app/commands.h"
#include "nonet/app/data_folder.h"
#include "nonet/app/option_checks.h"
#include "nonet/app/roboviz.h"
#include "nonet/app/stop_signal.h"
#include "nonet/app/tcp_match.h"
#include "nonet/app/team_name.h"
#include "nonet/app/trace_file.h"
#include "nonet/lab/common/folder_lock.h"
#include "nonet/lab/reports/match_agreement.h"
#include "nonet/lab/reports/match_kicks.h"
#include "nonet/lab/reports/match_localization.h"

namespace nonet::app {
namespace {

struct MatchArguments {
  TcpMatchSettings settings;
  int players = 9;
  int threads = 0;
  bool inProcess = false;
  bool localization = false;
  bool agreement = false;
  bool kicks = false;
  bool alone = false;
  bool truth = false;
  std::string json = "logs/match.json";
  std::vector<std::string> settingFiles;
  std::vector<std::string> assignments;
  std::string data;
};

using Traces = std::map<sim::AgentHandle, std::unique_ptr<TraceFile>>;

void addTrace(const std::string& folder, const lab::Thought& thought, std::unique_ptr<TraceFile>& file) {
  if (!file) {
    const agent::AgentSettings& agentSettings = thought.agent.settings();
    file = std::make_unique<TraceFile>(
        fmt::format("{}/{}_{}.trace", folder, agentSettings.team, agentSettings.unum));
  }
  file->add(thought.agent);
}

void endTraces(const Traces& traces, lab::MatchResult& result) {
  for (const auto& [agent, trace] : traces) {
    trace->close();
    if (!trace->error().empty()) result.warnings.push_back(trace->error());
  }
}

void draw(const lab::Thought& thought, std::unique_ptr<RobovizPainter>& painter) {
  if (!painter) painter = std::make_unique<RobovizPainter>("localhost");
  painter->show(thought.agent);
}

/// What is measured beside the result; the name is its key in the JSON.
struct Measurement {
  std::string name;
  std::unique_ptr<lab::MatchMeasure> measure;
};
using Measurements = std::vector<Measurement>;

Measurements askedFor(const MatchArguments& arguments) {
  Measurements measurements;
  if (arguments.localization)
    measurements.push_back({"localization", std::make_unique<lab::MatchLocalization>()});
  if (arguments.agreement) measurements.push_back({"agreement", std::make_unique<lab::MatchAgreement>()});
  if (arguments.kicks) measurements.push_back({"kicks", std::make_unique<lab::MatchKicks>()});
  return measurements;
}

lab::MatchResult playHere(const MatchArguments& arguments, Console& console, const Measurements& measured) {
  const lab::MatchSettings& match = arguments.settings.match;
  const int cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  const int threads = arguments.threads > 0 ? arguments.threads : cores;
  console.say(fmt::format("{}, seed {}, in one process with {} threads", lab::matchTitle(match), match.seed,
                          threads));
  const StopSignal stopSignal;
  lab::MatchObservers observers;
  observers.afterCycle = [&](const sim::Simulation& simulation, const lab::MatchWatcher& watcher) {
    if (console.due()) console.progress(watcher.progress(simulation));
    for (const Measurement& measurement : measured) measurement.measure->afterCycle(simulation);
    return !StopSignal::came();
  };
  Traces traces;
  std::map<sim::AgentHandle, std::unique_ptr<RobovizPainter>> painters;
  const TcpMatchSettings& settings = arguments.settings;
  if (!measured.empty() || settings.draw || !settings.traces.empty()) {
    observers.afterThought = [&](const lab::Thought& thought) {
      for (const Measurement& measurement : measured) measurement.measure->afterThought(thought);
      if (!settings.traces.empty()) addTrace(settings.traces, thought, traces[thought.handle]);
      if (settings.draw) draw(thought, painters[thought.handle]);
    };
  }
  lab::MatchResult result = lab::playInProcess(match, dataFolder(arguments.data), threads, observers);
  endTraces(traces, result);
  console.end();
  if (!result.finished) console.say("stopped by a signal");
  return result;
}

/// To the server, or to both teams.
void assign(const std::vector<std::string>& assignments, lab::MatchSettings& match) {
  for (const std::string& assignment : assignments) {
    if (!lab::namesParameter(assignment)) {
      lab::setServerSetting(match.settings, assignment);
      continue;
    }
    match.left.assignments.push_back(assignment);
    match.right.assignments.push_back(assignment);
  }
}

/// What would go wrong only after the match, or in every agent alone.
void checkBefore(MatchArguments& arguments) {
  lab::MatchSettings& match = arguments.settings.match;
  if (match.left.name == match.right.name)
    throw std::runtime_error("--left and --right must be different names");
  for (const std::string& name : {match.left.name, match.right.name}) checkTeamName(name);
  for (lab::TeamSettings* team : {&match.left, &match.right}) {
    if (team->players > 0) lab::checkRobotTypes(team->robotTypes, team->players);
    const char* own = team == &match.left ? "--left-data" : "--right-data";
    const std::string option = team->dataFolder.empty() ? "--data" : own;
    if (team->dataFolder.empty()) team->dataFolder = arguments.data;
    const std::string data = dataFolder(team->dataFolder, option);
    std::set<int> types;
    for (int unum = 1; unum <= team->players; ++unum) {
      const agent::AgentChoice choice = lab::agentChoice(match, team == &match.right, unum);
      if (types.insert(choice.robotType).second) (void)agent::makeAgentSettings(choice, data);
    }
  }
  const std::filesystem::path folder = std::filesystem::path(arguments.json).parent_path();
  if (!folder.empty()) lab::makeFolder(folder.string());
  if (!std::ofstream(arguments.json))  // and no result of an earlier match remains
    throw std::runtime_error(
        fmt::format("--json {}: cannot be written: give the name of a file", arguments.json));
}

int runMatch(MatchArguments& arguments) {
  lab::MatchSettings& match = arguments.settings.match;
  match.left.players = arguments.players;
  match.right.players = arguments.alone ? 0 : arguments.players;
  for (const std::string& file : arguments.settingFiles) match.settings.overlayFile(file);
  if (arguments.truth) match.settings.senseTruth();
  assign(arguments.assignments, match);
  checkBefore(arguments);

  if (!arguments.settings.traces.empty()) lab::makeFolder(arguments.settings.traces);

  Console console;
  const Measurements measured = askedFor(arguments);
  const lab::MatchResult result =
      arguments.inProcess ? playHere(arguments, console, measured) : playOverTcp(arguments.settings, console);
  fmt::print("{}", result.toText());
  for (const Measurement& measurement : measured) fmt::print("{}", measurement.measure->toText());
  std::ofstream file(arguments.json);
  nlohmann::ordered_json json = result.toJson();
  for (const Measurement& measurement : measured) json[measurement.name] = measurement.measure->toJson();
  file << json.dump(2) << "\n";
  if (!file.flush()) throw std::runtime_error("cannot write " + arguments.json);
  fmt::print("result in {}\n", arguments.json);
  const bool allThere = std::all_of(result.players.begin(), result.players.end(),
                                    [](const lab::PlayerRecord& player) { return player.connected; });
  return result.finished && result.violations == 0 && result.warnings.empty() && allThere ? 0 : 1;
}

void addGameOptions(CLI::App* command, MatchArguments& arguments) {
  lab::MatchSettings& match = arguments.settings.match;
  command->add_option("--minutes", match.minutes, "Game time in all, two halves")
      ->check(CLI::Range(0.01, 1e4));
  command->add_option("--kick-off-wait", match.kickOffWait, "Simulated seconds before each half")
      ->check(CLI::Range(0.0, 1e4));
  command->add_option("--seed", match.seed, "Seed of the server and of all agents");
  command->add_option("--players", arguments.players, "Players a side")->check(CLI::Range(1, 11));
  command->add_flag("--alone", arguments.alone, "The right team stays away");
}

void addTeamOptions(CLI::App* command, MatchArguments& arguments) {
  lab::MatchSettings& match = arguments.settings.match;
  command->add_option("--left", match.left.name, "Name of the left team");
  CLI::Option* alone = command->get_option("--alone");  // of a team that stays away nothing is asked
  command->add_option("--right", match.right.name, "Name of the right team")->excludes(alone);
  command
      ->add_option("--left-params", match.left.parameterFiles,
                   "A parameter file of the left team; given again, the later one lies over the earlier")
      ->allow_extra_args(false)
      ->check(CLI::ExistingFile);
  command->add_option("--right-params", match.right.parameterFiles, "The same of the right team")
      ->allow_extra_args(false)
      ->check(CLI::ExistingFile)
      ->excludes(alone);
  command->add_option("--left-data", match.left.dataFolder, "Folder with the left team's params/ and skills/")
      ->check(CLI::ExistingDirectory);
  command
      ->add_option("--right-data", match.right.dataFolder, "The same of the right team: an older state, say")
      ->check(CLI::ExistingDirectory)
      ->excludes(alone);
  command
      ->add_option("--left-set", match.left.assignments,
                   "One parameter of the left team's agents, name=value")
      ->allow_extra_args(false);
  command->add_option("--right-set", match.right.assignments, "The same of the right team's")
      ->allow_extra_args(false)
      ->excludes(alone);
  command
      ->add_option("--left-types", match.left.robotTypes,
                   "Robot types of the left team from number 1 on, such as 0,2,2,2,2,2,2,2,4")
      ->delimiter(',')
      ->check(CLI::Range(0, 4));
  command->add_option("--right-types", match.right.robotTypes, "The same of the right team")
      ->delimiter(',')
      ->check(CLI::Range(0, 4))
      ->excludes(alone);
  command->add_option("--data", arguments.data, "Folder with params/ and skills/ for both teams")
      ->check(CLI::ExistingDirectory);
}

void addServerOptions(CLI::App* command, MatchArguments& arguments) {
  TcpMatchSettings& settings = arguments.settings;
  command->add_option("--port", settings.port, "Port for agents, 0: any free one")->check(ownPort());
  command->add_option("--monitor-port", settings.monitorPort, "Port for monitors, 0: any free one")
      ->check(ownPort());
  command
      ->add_option("--answer-timeout", settings.answerTimeout,
                   "Lock-step: seconds after which a silent agent is no longer waited for")
      ->check(CLI::Range(0.01, 1e6));
  command->add_option("--settings", arguments.settingFiles, "Files with settings of the server")
      ->check(CLI::ExistingFile);
  command
      ->add_option("--set", arguments.assignments,
                   "One value, name=value: a setting of the server (SayLossShare=0.2), or with a dot a "
                   "parameter of all "
                   "agents (team.ball.kick=false)")
      ->allow_extra_args(false);
}

void addRecordings(CLI::App* command, MatchArguments& arguments) {
  TcpMatchSettings& settings = arguments.settings;
  command->add_option("--json", arguments.json, "File for the result");
  command->add_flag(
      "--truth", arguments.truth,
      "The server tells each agent where it and the ball are; nobody plays by it, but logs with "
      "it can be judged by `nonet replay --localization`");
  command->add_flag("--draw", settings.draw,
                    "Draw what the agents believe and want on the RoboViz of this machine (UDP port 32769)");
  command->add_option(
      "--trace", settings.traces,
      "Folder for one decision trace per agent: what it believes and wants, for `nonet view`");
  command->add_option(
      "--monitor-log", settings.match.monitorLog,
      "Record the monitor stream for `nonet view` (zstd; plain, for RoboViz, if the name ends "
      "in .log)");
}

/// In one process there are neither logs nor a clock to play by.
void addWayOfPlaying(CLI::App* command, MatchArguments& arguments) {
  TcpMatchSettings& settings = arguments.settings;
  CLI::Option* realTime =
      command->add_flag("--realtime", settings.realTime, "Play by the clock instead of in lock-step");
  CLI::Option* logs =
      command->add_option("--logs", settings.logs, "Folder for one log per agent, for `nonet replay`");
  command->add_flag("--check", settings.match.check,
                    "Look in every cycle whether the physics holds: finite, within stops, above the ground");
  CLI::Option* inProcess = command
                               ->add_flag("--in-process", arguments.inProcess,
                                          "Agents and world in this process, without text and sockets")
                               ->excludes(logs, realTime);
  command
      ->add_flag(
          "--localization", arguments.localization,
          "With --in-process: what all players believe of their place, the ball and each other against "
          "the simulation's truth")
      ->needs(inProcess);
  command
      ->add_flag(
          "--agreement", arguments.agreement,
          "With --in-process: in what share of the cycles all field players of a team mean the same "
          "assignment of roles; --set SayLossShare=0.2 makes each listener miss a fifth of what is said")
      ->needs(inProcess);
  command
      ->add_flag("--kicks", arguments.kicks,
                 "With --in-process: how far each kick was meant to go, how far the ball went and how far "
                 "off its way")
      ->needs(inProcess);
  command
      ->add_option("--threads", arguments.threads,
                   "With --in-process: threads for agents and physics, 0: one per core")
      ->check(threadCount())
      ->needs(inProcess);
}

}  // namespace

void addMatchCommand(CLI::App& app, int& exitCode) {
  CLI::App* command = app.add_subcommand("match", "Two teams of our agents play on the embedded server");
  auto arguments = std::make_shared<MatchArguments>();
  addGameOptions(command, *arguments);
  addTeamOptions(command, *arguments);
  addServerOptions(command, *arguments);
  addRecordings(command, *arguments);
  addWayOfPlaying(command, *arguments);
  command->footer(
      "Examples:\n"
      "  nonet match --minutes 2 --seed 7 --logs logs          over TCP, a log for nonet replay of each "
      "agent\n"
      "  nonet match --in-process --minutes 2 --monitor-log logs/match.mon --trace logs/traces\n"
      "  nonet match --alone --set QuickSolver=true --set team.ball.kick=false\n"
      "In lock-step the same seed gives the same match, over TCP and in one process, to the last byte of the "
      "logs.\n"
      "Exit codes: 0 played to the end, 1 not, or --check found something, or a recording is not whole.");
  command->callback([arguments, &exitCode] { exitCode = runMatch(*arguments); });
}

}  // namespace nonet::app
