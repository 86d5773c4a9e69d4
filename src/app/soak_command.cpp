#include <ctime>
#include <fstream>
#include <memory>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "nonet/app/commands.h"
#include "nonet/app/console.h"
#include "nonet/app/option_checks.h"
#include "nonet/app/soak/fault_soak.h"
#include "nonet/app/soak/match_soak.h"
#include "nonet/app/stop_signal.h"
#include "nonet/lab/common/atomic_file.h"
#include "nonet/lab/common/folder_lock.h"
#include "nonet/lab/match/random_effectors.h"

namespace nonet::app {
namespace {

using Json = nlohmann::ordered_json;

struct SoakArguments {
  MatchSoakSettings matches;
  FaultSoakSettings faults;
  lab::RandomEffectorsSettings effectors;
  bool harm = false;
  double effectorMinutes = 0.0;
  std::uint64_t seed = 1;
  int players = 0;
  std::string out;
  bool json = false;
};

int say(const SoakArguments& arguments, const Json& result, const std::string& text, bool good) {
  fmt::print("{}", arguments.json ? result.dump(2) + "\n" : text);
  return good ? 0 : 1;
}

int runMatches(SoakArguments& arguments, Console& console) {
  const bool good = soakMatches(arguments.matches, console);
  std::ifstream file(arguments.out + "/result.json");
  const Json sum = Json::parse(file);
  std::string text = fmt::format("{} of {} matches", sum["matches"].get<int>(), arguments.matches.matches);
  for (const auto& [key, value] : sum.items()) {
    if (key == "matches") continue;
    text += value.is_number_float() ? fmt::format("\n  {:<24} {:.2f}", key, value.get<double>())
                                    : fmt::format("\n  {:<24} {}", key, value.dump());
  }
  text += fmt::format("\nresult in {0}/result.json{1}\n", arguments.out,
                      sum["matches"].get<int>() < arguments.matches.matches
                          ? fmt::format("; the same command goes on (--out {})", arguments.out)
                          : "");
  return say(arguments, sum, text, good);
}

int runFaults(SoakArguments& arguments, Console& console) {
  const Json result = soakFaults(arguments.faults, console);
  lab::writeAtomically(arguments.out + "/faults.json", result.dump(2) + "\n");
  std::string text =
      fmt::format("{:<12} {:>5} {:>9} {:>22}\n", "fault", "times", "survived", "all in play after s");
  for (const auto& [kind, tally] : result["faults"].items()) {
    text += fmt::format("{:<12} {:>5} {:>9} {:>22.2f}\n", kind, tally["times"].get<int>(),
                        tally["survived"].get<int>(), tally["longest_s"].get<double>());
    for (const auto& trouble : tally["troubles"]) text += fmt::format("    {}\n", trouble.get<std::string>());
  }
  text += fmt::format("result in {}/faults.json\n", arguments.out);
  return say(arguments, result, text, result["complete"].get<bool>());
}

int runEffectors(SoakArguments& arguments, Console& console) {
  const StopSignal stopSignal;
  spdlog::set_level(spdlog::level::off);  // who enters, and what is refused
  arguments.effectors.minutes = arguments.effectorMinutes;
  const lab::RandomEffectorsResult result =
      lab::playRandomEffectors(arguments.effectors, [&](const auto& soFar) {
        if (console.due()) {
          console.progress(fmt::format("{:.1f} of {:g} min, {} robots built, {} violations",
                                       static_cast<double>(soFar.cycles) * kCycleTime / 60.0,
                                       arguments.effectorMinutes, soFar.entered, soFar.violations));
        }
        return !StopSignal::came();
      });
  console.end();
  const Json json = {{"cycles", result.cycles},
                     {"messages", result.messages},
                     {"placed", result.placed},
                     {"entered", result.entered},
                     {"signature", fmt::format("{:016x}", result.signature)},
                     {"violations", result.violations},
                     {"first_violations", result.messagesOfViolations},
                     {"overshoot_rad", result.extremes.overshoot},
                     {"lowest_m", result.extremes.lowestCentre},
                     {"fastest_m_per_s", result.extremes.fastestBody}};
  std::string text = fmt::format(
      "{} cycles ({:.1f} min), {} messages, {} robots built, signature {:016x}\n{} violations; farthest "
      "beyond a "
      "stop {:.3f} rad, lowest {:.3f} m, fastest {:.1f} m/s\n",
      result.cycles, static_cast<double>(result.cycles) * kCycleTime / 60.0, result.messages, result.entered,
      result.signature, result.violations, result.extremes.overshoot, result.extremes.lowestCentre,
      result.extremes.fastestBody);
  for (const std::string& message : result.messagesOfViolations) text += "  " + message + "\n";
  return say(arguments, json, text, result.violations == 0 && !result.stopped);
}

int runSoak(SoakArguments& arguments) {
  if (arguments.out.empty())
    arguments.out = fmt::format("logs/soak-{:%Y%m%d-%H%M%S}", fmt::gmtime(std::time(nullptr)));
  arguments.matches.out = arguments.faults.out = arguments.out;
  arguments.matches.seed = arguments.faults.seed = arguments.effectors.seed = arguments.seed;
  if (arguments.players > 0)
    arguments.matches.players = arguments.faults.players = arguments.effectors.players = arguments.players;
  Console console(arguments.json ? stderr : stdout);
  if (arguments.effectorMinutes > 0.0) return runEffectors(arguments, console);
  lab::makeFolder(arguments.out);
  const std::shared_ptr<void> lock = lab::lockFolder(arguments.out);
  return arguments.harm ? runFaults(arguments, console) : runMatches(arguments, console);
}

}  // namespace

void addSoakCommand(CLI::App& app, int& exitCode) {
  CLI::App* command =
      app.add_subcommand("soak", "Unattended matches, faults, or any well-formed commands: what breaks");
  auto arguments = std::make_shared<SoakArguments>();
  MatchSoakSettings& matches = arguments->matches;
  FaultSoakSettings& faults = arguments->faults;
  command->add_option("--matches", matches.matches, "Whole matches over TCP")->check(CLI::Range(1, 100000));
  command->add_option("--minutes", matches.minutes, "Game time of a match")->check(CLI::Range(0.01, 1e4));
  command->add_option("--kick-off-wait", matches.kickOffWait, "Simulated seconds before each half")
      ->check(CLI::Range(0.0, 1e4));
  command
      ->add_option("--realtime-share", matches.realTimeShare,
                   "Share of matches by the clock, not in lock-step")
      ->check(CLI::Range(0.0, 1.0));
  command->add_option("--eleven-share", matches.elevenShare, "Share of matches of eleven against eleven")
      ->check(CLI::Range(0.0, 1.0));
  command->add_flag("--keep-logs", matches.keepLogs, "Keep the logs of good matches as well");
  CLI::Option* harm =
      command->add_flag("--faults", arguments->harm, "One match in real time that is harmed instead");
  command->add_option("--times", faults.times, "With --faults: how often each kind")
      ->needs(harm)
      ->check(CLI::Range(1, 10000));
  command->add_option("--kinds", faults.kinds, "With --faults: only these kinds")
      ->needs(harm)
      ->delimiter(',')
      ->check(CLI::IsMember(faultKinds()));
  command->add_option("--pause", faults.pause, "With --faults: seconds between two, about")
      ->needs(harm)
      ->check(CLI::Range(0.0, 3600.0));
  command
      ->add_option(
          "--effectors", arguments->effectorMinutes,
          "So many minutes of random commands in one process instead, the physics watched in every cycle")
      ->excludes(harm)
      ->check(moreThanZero());
  command
      ->add_flag("!--no-beams", arguments->effectors.beams,
                 "With --effectors: nothing that puts robots into each other; the bounds are narrow then")
      ->needs(command->get_option("--effectors"));
  command->add_option("--seed", arguments->seed, "Decides everything that is drawn");
  command
      ->add_option("--players", arguments->players,
                   "Players a side; default 9, with --faults 3, with --effectors 4")
      ->check(CLI::Range(2, 11));
  command->add_option(
      "--out", arguments->out,
      "Folder of matches, which are not played again, or of --faults; --effectors writes nothing");
  command->add_flag("--json", arguments->json, "Print the result as JSON");
  command->footer(
      "Examples:\n"
      "  nonet soak --matches 100 --out logs/soak          whole matches, lock-step and real time mixed\n"
      "  nonet soak --matches 20 --minutes 0.5 --realtime-share 0\n"
      "  nonet soak --faults --times 20                    agents, connections, server and disk are harmed\n"
      "  nonet soak --faults --kinds kill,cut --times 3\n"
      "  nonet soak --effectors 60 --seed 3                an hour of anything that is well-formed\n"
      "Matches that were stopped go on with the same command and --out; --faults and --effectors begin "
      "anew.\n"
      "Exit codes: 0 all done without a fault, 1 not.");
  command->callback([arguments, &exitCode] { exitCode = runSoak(*arguments); });
}

}  // namespace nonet::app
