#include "nonet/lab/match/match.h"

#include <array>
#include <chrono>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "nonet/config/assignment.h"
#include "nonet/math/angle.h"
#include "nonet/model/robot_model.h"
#include "nonet/protocol/play_mode.h"
#include "nonet/sim/referee/game_state.h"
#include "nonet/sim/server/lobby.h"
#include "nonet/sim/server/monitor.h"

namespace nonet::lab {
namespace {

// Cosine of the torso's tilt. Between the two a robot keeps the stance it had, so a stumble counts once.
constexpr float kFallenBelow = 0.5F;
constexpr float kStandingAbove = 0.9F;
constexpr int kLinger = 50;  // cycles after GameOver, as many as the server plays on

struct InProcessPlayer {
  sim::AgentHandle handle = sim::kNoAgent;
  std::unique_ptr<agent::Agent> agent;
  const protocol::Percept* percept = nullptr;  // of this cycle, if there is one
  protocol::Effectors answer;
  bool answered = false;
  long messages = 0;
};

// The handshake that a server with a lobby plays, so that a match is the same as over TCP to the last bit.
void enter(std::vector<InProcessPlayer>& players, sim::Simulation& simulation, std::uint64_t seed) {
  std::vector<protocol::InitEffector> inits;
  for (InProcessPlayer& player : players) {
    sim::Lobby lobby(simulation.settings(), seed);
    const protocol::Percept* percept = lobby.receive(player.agent->hello());
    while (percept != nullptr && !lobby.ready()) percept = lobby.receive(player.agent->step(*percept));
    inits.push_back(lobby.init().value());
  }
  for (const std::size_t i : sim::entryOrder(simulation.settings(), inits)) {
    players[i].handle = simulation.enter(*players[i].agent->hello().scene, inits[i]);
  }
}

int robotTypeOf(const TeamSettings& team, int unum) {
  return team.robotTypes.empty() ? agent::usualRobotType(unum)
                                 : team.robotTypes.at(static_cast<std::size_t>(unum - 1));
}

}  // namespace

void checkRobotTypes(const std::vector<int>& robotTypes, int players) {
  if (robotTypes.empty()) return;
  if (robotTypes.size() != static_cast<std::size_t>(players))
    throw std::runtime_error(fmt::format("{} robot types for {} players: give one for each, such as 0,2,2,4",
                                         robotTypes.size(), players));
  const sim::Settings settings;
  sim::GameState state(settings);
  for (int unum = 1; unum <= players; ++unum) {
    const int type = robotTypes[static_cast<std::size_t>(unum - 1)];
    if (type < 0 || type >= model::kRobotTypeCount)
      throw std::runtime_error(
          fmt::format("robot type {}: there are 0 to {}", type, model::kRobotTypeCount - 1));
    sim::TeamSide side = sim::TeamSide::None;
    int number = unum;
    if (state.registerPlayer("team", type, side, number, settings) != sim::GameState::Refusal::None)
      throw std::runtime_error(fmt::format(
          "the server would refuse number {} of type {}: at most {} of one type, {} of any two, at "
          "least {} types in a team of eleven",
          unum, type, settings.maxRobotTypeCount, settings.maxSumTwoRobotTypes, settings.minRobotTypesCount));
  }
}

std::string matchTitle(const MatchSettings& match) {
  if (match.right.players == 0)
    return fmt::format("{} alone, {} players", match.left.name, match.left.players);
  return fmt::format("{} against {}, {} a side", match.left.name, match.right.name, match.left.players);
}

sim::Settings simulationSettings(const MatchSettings& match) {
  sim::Settings settings = match.settings;
  settings.ruleHalfTime = match.minutes * 60.0 / 2.0;
  settings.automaticKickOff = true;
  settings.waitBeforeKickOff = match.kickOffWait;
  settings.leftTeam = match.left.name;
  settings.rightTeam = match.right.name;
  return settings;
}

bool namesParameter(std::string_view assignment) {
  return assignment.substr(0, assignment.find('=')).find('.') != std::string_view::npos;
}

void setServerSetting(sim::Settings& settings, const std::string& assignment) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 5> kDecided{
      {{"RuleHalfTime", "give the game time by --minutes"},
       {"WaitBeforeKickOff", "give it by --kick-off-wait"},
       {"AutomaticKickOff", "there is nobody else who would kick off"},
       {"LeftTeam", "name the teams by their options"},
       {"RightTeam", "name the teams by their options"}}};
  const std::string_view name = config::trimmed(std::string_view(assignment).substr(0, assignment.find('=')));
  for (const auto& [decided, advice] : kDecided) {
    if (name == decided)
      throw std::runtime_error(fmt::format("{}: the match decides this itself: {}", assignment, advice));
  }
  settings.setAssignment(assignment);
}

agent::AgentChoice agentChoice(const MatchSettings& match, bool rightTeam, int unum) {
  const TeamSettings& team = rightTeam ? match.right : match.left;
  agent::AgentChoice agent;
  agent.unum = unum;
  agent.team = team.name;
  agent.robotType = robotTypeOf(team, unum);
  agent.seed = agent::agentSeed(match.seed, rightTeam, unum);
  agent.parameterFiles = team.parameterFiles;
  agent.assignments = team.assignments;
  return agent;
}

MatchWatcher::MatchWatcher(const MatchSettings& match) {
  result_.teamLeft = match.left.name;
  result_.teamRight = match.right.name;
  result_.seed = match.seed;
  for (const bool rightTeam : {false, true}) {
    const TeamSettings& team = rightTeam ? match.right : match.left;
    for (int unum = 1; unum <= team.players; ++unum) {
      PlayerRecord player;
      player.rightTeam = rightTeam;
      player.team = team.name;
      player.unum = unum;
      player.robotType = robotTypeOf(team, unum);
      result_.players.push_back(player);
    }
  }
  if (match.check) invariants_.emplace();
  stances_.assign(result_.players.size(), Stance::Unknown);
}

PlayerRecord* MatchWatcher::find(bool rightTeam, int unum) {
  for (PlayerRecord& player : result_.players) {
    if (player.rightTeam == rightTeam && player.unum == unum) return &player;
  }
  return nullptr;
}

void MatchWatcher::update(const sim::Simulation& simulation) {
  const sim::MatchState& match = simulation.match();
  ++result_.cycles;
  if (invariants_) invariants_->check(simulation);
  // The score of whoever began on the left, on whichever side it plays now.
  const bool changed = match.teamLeft.view() == result_.teamRight;
  result_.scoreLeft = changed ? match.scoreRight : match.scoreLeft;
  result_.scoreRight = changed ? match.scoreLeft : match.scoreRight;
  result_.gameTime = match.time;
  result_.finished = match.playMode == protocol::PlayMode::GameOver;

  for (PlayerRecord& player : result_.players) player.gone = player.connected;
  for (const sim::AgentInfo& agent : simulation.agents()) {
    if (agent.unum == 0) continue;
    // Names stay with the team if the sides are changed at half time.
    PlayerRecord* player = find(agent.team.view() == result_.teamRight, agent.unum);
    if (player == nullptr) continue;
    player->connected = true;
    player->gone = false;
    const float up = simulation.world().bodyPose(agent.robot, model::BodyId::Torso).rotation(2, 2);
    Stance& stance = stances_[static_cast<std::size_t>(player - result_.players.data())];
    if (up < kFallenBelow && stance == Stance::Standing) ++player->falls;
    if (up < kFallenBelow) stance = Stance::Fallen;
    if (up > kStandingAbove) stance = Stance::Standing;
    if (player->falls == 0) player->standingAfterKickOff = match.time;
  }
}

MatchResult MatchWatcher::finish(const sim::Simulation& simulation) {
  result_.signature = simulation.signature();
  if (invariants_) {
    const sim::InvariantExtremes& extremes = invariants_->extremes();
    result_.violations = invariants_->violations();
    result_.invariants = fmt::format(
        "invariants: {} violations; farthest beyond a stop {:.2f} deg, lowest body centre {:.3f} m, fastest "
        "body {:.1f} m/s\n",
        invariants_->violations(), toDegrees(extremes.overshoot), extremes.lowestCentre,
        extremes.fastestBody);
    for (const std::string& message : invariants_->messages()) result_.invariants += message + "\n";
  }
  return result_;
}

std::string MatchWatcher::progress(const sim::Simulation& simulation) const {
  const sim::MatchState& match = simulation.match();
  const sim::Vector3f ball = simulation.world().ballPosition();
  const int seconds = static_cast<int>(match.time);
  return fmt::format("{:02}:{:02} {} {} : {} {}  {:<16} ball {:6.2f} {:6.2f}  falls {} : {}", seconds / 60,
                     seconds % 60, result_.teamLeft, result_.scoreLeft, result_.scoreRight, result_.teamRight,
                     protocol::playModeName(match.playMode), ball.x(), ball.y(), result_.falls(false),
                     result_.falls(true));
}

MatchResult playInProcess(const MatchSettings& match, const std::string& dataFolder, int threads,
                          const MatchObservers& observers) {
  sim::Settings settings = simulationSettings(match);
  settings.threads = threads;
  settings.threadPatience = 300;  // us: longer than what is done by one thread alone in a cycle
  sim::Simulation simulation(settings, match.seed);
  MatchWatcher watcher(match);
  std::vector<InProcessPlayer> players;
  for (const PlayerRecord& record : watcher.result().players) {
    const agent::AgentChoice agent = agentChoice(match, record.rightTeam, record.unum);
    const std::string& own = record.rightTeam ? match.right.dataFolder : match.left.dataFolder;
    players.emplace_back().agent =
        std::make_unique<agent::Agent>(agent::makeAgentSettings(agent, own.empty() ? dataFolder : own));
  }
  enter(players, simulation, match.seed);
  std::optional<sim::MonitorLog> monitorLog;
  if (!match.monitorLog.empty()) monitorLog.emplace(simulation, match.monitorLog);

  // As over TCP, the agents think about the messages that beginCycle() sent while the physics goes on.
  const sim::SharedWork thoughts{players.size(), [&players](std::size_t i) {
                                   InProcessPlayer& player = players[i];
                                   player.answered = player.percept != nullptr;
                                   if (!player.answered) return;
                                   ++player.messages;
                                   player.answer = player.agent->step(*player.percept);
                                 }};
  const auto start = std::chrono::steady_clock::now();
  int afterEnd = 0;
  for (bool more = true; more;) {
    for (const InProcessPlayer& player : players) {
      if (!player.answered) continue;
      simulation.act(player.handle, player.answer);
      if (observers.afterThought) {
        observers.afterThought(
            {player.handle, *simulation.sense(player.handle), *player.agent, player.answer});
      }
    }
    simulation.beginCycle();
    for (InProcessPlayer& player : players) player.percept = simulation.sense(player.handle);
    simulation.finishCycle(thoughts);
    if (monitorLog) monitorLog->cycle();
    watcher.update(simulation);
    if (watcher.result().finished && ++afterEnd > kLinger) more = false;
    if (observers.afterCycle && !observers.afterCycle(simulation, watcher)) more = false;
  }
  MatchResult result = watcher.finish(simulation);
  if (monitorLog) {
    monitorLog->close();
    if (monitorLog->failed()) result.warnings.push_back(monitorLog->error());
  }
  for (std::size_t i = 0; i < players.size(); ++i) {
    PlayerRecord& record = result.players[i];
    record.messages = players[i].messages;
    if (!record.connected) record.ending = "refused by the server";
  }
  result.wallTime = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace nonet::lab
