#include <fmt/format.h>

#include "nonet/agent/agent_setup.h"
#include "nonet/app/commands.h"
#include "nonet/app/data_folder.h"
#include "nonet/app/option_checks.h"
#include "nonet/app/play_client.h"
#include "nonet/app/team_name.h"

namespace nonet::app {
namespace {

struct PlayArguments {
  agent::AgentChoice choice;
  PlaySettings play;
  std::string sync = "auto";
  std::vector<double> start;  // x, y in metres; heading 0
  std::string challenge;
  std::string data;
  bool draw = false;
  std::string drawHost = "localhost";
};

/// An unknown name is no reason not to come: a challenge of a later year.
void chooseChallenge(PlayArguments& arguments) {
  const auto challenge = team::challengeFromName(arguments.challenge);
  arguments.choice.challenge = challenge.value_or(team::Challenge::None);
  const bool ownTask = challenge == team::Challenge::Run || challenge == team::Challenge::Kick;
  fmt::print("challenge {}: {}\n", arguments.challenge,
             ownTask ? "the agent starts at its place and does that"
             : challenge
                 ? "the agent starts at its place and plays as in a match"
                 : "this name is not known (run, kick, goalie, passing, keepaway): it plays as in a match");
}

int runPlay(PlayArguments& arguments) {
  checkTeamName(arguments.choice.team);
  if (!arguments.start.empty()) {
    arguments.choice.startPose = Pose2(arguments.start.at(0), arguments.start.at(1), 0.0);
  }
  if (!arguments.challenge.empty()) {
    chooseChallenge(arguments);
  }
  PlaySettings& play = arguments.play;
  if (arguments.draw) play.draw = arguments.drawHost;
  play.session.agent = agent::makeAgentSettings(arguments.choice, dataFolder(arguments.data));
  // A server in real time ignores (syn), so there is nothing to find out: auto means on, and takes care of
  // servers that hang before the first message.
  play.session.sync = arguments.sync != "off";
  play.rescue = arguments.sync == "auto";
  play.recordHeader = agent::logHeader(play.session.agent, NONET_VERSION, play.session.sync);
  return static_cast<int>(nonet::app::play(play));
}

}  // namespace

void addPlayCommand(CLI::App& app, int& exitCode) {
  CLI::App* command = app.add_subcommand("play", "One agent plays on a server");
  auto arguments = std::make_shared<PlayArguments>();
  agent::AgentChoice& choice = arguments->choice;
  PlaySettings& play = arguments->play;
  command->add_option("--host", play.host, "Host of the server");
  command->add_option("--port", play.port, "Port for agents")->check(otherPort());
  command->add_option("--unum", choice.unum, "Uniform number, 0: the server chooses")
      ->check(CLI::Range(0, 11));
  command->add_option("--team", choice.team, "Name of the team");
  command->add_option("--type", choice.robotType, "Robot type")->check(CLI::Range(0, 4));
  CLI::Option* draw = command->add_flag("--draw", arguments->draw,
                                        "Draw what the agent believes and wants on RoboViz (UDP port 32769)");
  command->add_option("--draw-host", arguments->drawHost, "With --draw: where RoboViz runs")->needs(draw);
  command->add_option("--trace", play.trace,
                      "Write what the agent believes and wants in each cycle (JSON lines, zstd)");
  command->add_option("--record", play.record, "Write a log for `nonet replay` (compressed with zstd)");
  command
      ->add_option("--sync", arguments->sync,
                   "End answers with (syn), for lock-step servers: on does, off does not; auto does, and "
                   "frees servers that hang before their first message")
      ->check(CLI::IsMember({"auto", "on", "off"}));
  command
      ->add_option("--params", choice.parameterFiles,
                   "A parameter file; given again, the later one lies over the earlier")
      ->allow_extra_args(false)
      ->check(CLI::ExistingFile);
  command
      ->add_option("--set", choice.assignments,
                   "One parameter, name=value, such as team.ball.kick=false; set last")
      ->allow_extra_args(false);
  command->add_option("--data", arguments->data, "Folder with params/ and skills/")
      ->check(CLI::ExistingDirectory);
  command->add_option("--seed", choice.seed, "Seed of the agent's random numbers");
  command->add_option("--wait", play.wait, "Seconds to wait for a server, and for its first message")
      ->check(moreThanZero());
  command->add_flag("--reconnect", play.reconnect,
                    "Come back to a server that is started again, or after a cut connection; give up after "
                    "--wait seconds. Each connection has its own log: 3.zst, 3.2.zst, ...");
  command->add_option("--start", arguments->start, "Beam to X,Y instead of the kick-off place")
      ->delimiter(',')
      ->expected(2);
  CLI::Option* challenge = command->add_option("--challenge", arguments->challenge,
                                               "Technical challenge: run, kick, goalie, passing or keepaway");
  CLI::Option* skill =
      command
          ->add_option("--skill", choice.skill,
                       "Show this skill instead of playing, again and again, 2 s of standing before each")
          ->excludes(challenge);
  command->add_flag("--mirror", choice.mirrorSkill, "With --skill: left and right exchanged")->needs(skill);
  command->add_option("--report", play.report, "Write what was counted as JSON at the end");
  command->add_flag("--at-once", play.atOnce,
                    "Connect without waiting for other agents of this machine to introduce themselves");
  command->add_flag("--quiet", play.quiet, "Say only what went wrong");
  command->footer(
      "Examples:\n"
      "  nonet play --host localhost --unum 3 --team Nonet --type 4 --record 3.zst\n"
      "  nonet play --unum 2 --type 2 --set team.ball.kick=false --draw\n"
      "  nonet play --skill dive --type 0          shows a skill instead of playing\n"
      "Exit codes: 0 stopped by a signal, 1 error, 2 no server, 3 the server is gone, 4 refused by the "
      "server.");
  command->callback([arguments, &exitCode] { exitCode = runPlay(*arguments); });
}

}  // namespace nonet::app
