#include "nonet/sim/simulation.h"

#include <algorithm>
#include <cmath>

#include <spdlog/spdlog.h>

#include "nonet/protocol/rounding.h"

#include "sim/simulation_implementation.h"

namespace nonet::sim {

namespace {

constexpr std::uint64_t kRefereeStream = 1;
constexpr std::uint64_t kConnectionStream = 0x1000;  // + handle
constexpr int kVisionInterval = 3;                   // messages

VisionField::Size fieldSize(const Settings& s) {
  return {s.fieldLength, s.fieldWidth,    s.goalWidth,    s.goalDepth,
          s.goalHeight,  s.penaltyLength, s.penaltyWidth, s.freeKickDistance};
}

}  // namespace

Simulation::Implementation::Implementation(const Settings& s, std::uint64_t seed)
    : settings(s),
      random(seed),
      world(s.world()),
      referee(settings, world, players, random.fork(kRefereeStream).next()),
      trainer(world, referee, players),
      field(fieldSize(settings)) {
  updateMatch();
}

Agent* Simulation::Implementation::find(AgentHandle handle) {
  const auto it = std::find_if(agents.begin(), agents.end(),
                               [handle](const auto& agent) { return agent->handle == handle; });
  return it == agents.end() ? nullptr : it->get();
}

const Agent* Simulation::Implementation::find(AgentHandle handle) const {
  return const_cast<Implementation*>(this)->find(handle);
}

Player* Simulation::Implementation::playerOf(const Agent& agent) {
  for (Player& player : players) {
    if (player.agent == agent.handle) return &player;
  }
  return nullptr;
}

Agent& Simulation::Implementation::addAgent() {
  auto agent = std::make_unique<Agent>();
  agent->handle = nextHandle++;
  agent->noise = random.fork(kConnectionStream + static_cast<std::uint64_t>(agent->handle));
  agents.push_back(std::move(agent));
  ++sceneVersion;
  return *agents.back();
}

// Players whose init has not succeeded are not seen (server facts 1.6).
void Simulation::Implementation::listVisiblePlayers() {
  visible.clear();
  for (const Player& player : players) {
    if (player.side != TeamSide::None) visible.push_back({player.robot, player.team, player.unum});
  }
}

// The message of server facts 1.5, as values. Rounding: protocol/rounding.h.
void Simulation::Implementation::makeSenses(Agent& agent) {
  const int count = ++agent.senseCount;
  const Player* player = playerOf(agent);
  // The server finds a new robot's perceptors one cycle after it was built: its first message is made then.
  agent.hasMade = player != nullptr && ++agent.robotCycles > 1;
  if (!agent.hasMade) return;
  protocol::Percept& percept = agent.made;
  percept.clear();
  percept.time = protocol::roundToWire(serverTime);
  percept.order.push_back({protocol::PerceptKind::Time, 0});

  protocol::GameStatus& game = percept.game;
  if (!agent.announced && player->side != TeamSide::None) {
    agent.announced = true;
    game.unum = player->unum;
    game.side = player->side;
  }
  if (settings.reportScore) {
    game.scoreLeft = match.scoreLeft;
    game.scoreRight = match.scoreRight;
  }
  game.time = protocol::roundToWire(match.time);
  game.playMode = match.playMode;
  game.playModeText = protocol::playModeName(match.playMode);
  percept.order.push_back({protocol::PerceptKind::GameState, 0});

  agent.ear.deliver(player->team, match.time, settings.labelMessages, percept);
  SensorContext context;
  context.field = &field;
  context.players = visible;
  context.side = player->side;
  context.vision = count % kVisionInterval == 0;
  context.noise = settings.visionNoise;
  context.truePosition = settings.senseMyPos;
  context.trueHeading = settings.senseMyOrien;
  context.trueBallPosition = settings.senseBallPos;
  agent.sensors.fill(world, player->robot, context, agent.noise, percept);
}

void Simulation::Implementation::updateMatch() {
  const GameState& game = referee.game();
  match.playMode = game.playMode();
  match.time = game.time();
  match.serverTime = serverTime;
  match.half = game.half();
  match.scoreLeft = game.score(TeamSide::Left);
  match.scoreRight = game.score(TeamSide::Right);
  match.teamLeft = game.teamName(TeamSide::Left);
  match.teamRight = game.teamName(TeamSide::Right);
  match.passModeScoreWaitLeft = game.passModeScoreWait(TeamSide::Left, settings);
  match.passModeScoreWaitRight = game.passModeScoreWait(TeamSide::Right, settings);
}

Simulation::Simulation(const Settings& settings, std::uint64_t seed)
    : implementation_(std::make_unique<Implementation>(settings, seed)) {}

Simulation::~Simulation() = default;

const Settings& Simulation::settings() const {
  return implementation_->settings;
}

AgentHandle Simulation::connect() {
  return implementation_->addAgent().handle;
}

AgentHandle Simulation::enter(const protocol::SceneEffector& scene, const protocol::InitEffector& init) {
  Agent& agent = implementation_->addAgent();
  agent.enters = true;
  // Connected one after the other, players do not all see in the same cycle.
  agent.senseCount = agent.handle % kVisionInterval;
  agent.scene = scene;
  agent.init = init;
  return agent.handle;
}

void Simulation::disconnect(AgentHandle agent) {
  if (Agent* found = implementation_->find(agent)) found->gone = true;
}

bool Simulation::isConnected(AgentHandle agent) const {
  const Agent* found = implementation_->find(agent);
  return found != nullptr && !found->gone;
}

void Simulation::act(AgentHandle agent, const protocol::Effectors& effectors) {
  if (Agent* found = implementation_->find(agent)) {
    found->inbox.push_back(effectors);
    protocol::roundAsWritten(found->inbox.back());
  }
}

void Simulation::actAsReceived(AgentHandle agent, const protocol::Effectors& effectors) {
  if (Agent* found = implementation_->find(agent)) found->inbox.push_back(effectors);
}

const protocol::Percept* Simulation::sense(AgentHandle agent) const {
  const Agent* found = implementation_->find(agent);
  return found != nullptr && found->hasSent ? &found->sent : nullptr;
}

bool Simulation::sense(AgentHandle agent, protocol::Percept& percept) const {
  const protocol::Percept* sent = sense(agent);
  if (sent != nullptr) percept = *sent;
  return sent != nullptr;
}

std::vector<AgentInfo> Simulation::agents() const {
  std::vector<AgentInfo> infos;
  for (const auto& agent : implementation_->agents) {
    AgentInfo info;
    info.handle = agent->handle;
    if (const Player* player = implementation_->playerOf(*agent)) {
      info.robot = player->robot;
      info.side = player->side;
      info.unum = player->unum;
      info.robotType = player->robotType;
      info.team = player->team;
      info.selected = player->selected;
    }
    infos.push_back(info);
  }
  return infos;
}

void Simulation::step() {
  beginCycle();
  finishCycle();
}

void Simulation::beginCycle() {
  for (const auto& agent : implementation_->agents) {
    if (!agent->gone) {
      for (const protocol::Effectors& message : agent->inbox) implementation_->receive(*agent, message);
    }
    agent->inbox.clear();
  }
  for (const auto& agent : implementation_->agents) {
    std::swap(agent->made, agent->sent);
    agent->hasSent = agent->hasMade;
  }
}

void Simulation::finishCycle(const SharedWork& alongside) {
  Implementation& self = *implementation_;
  for (const auto& agent : self.agents) {
    if (!agent->gone) self.executeDeferred(*agent);
  }
  self.world.prePhysics();
  for (const auto& agent : self.agents) {
    if (!agent->gone) self.executeScene(*agent);
  }
  self.world.stepPhysics(alongside);
  self.removeGoneAgents();
  const TeamName leftBefore = self.referee.game().teamName(TeamSide::Left);
  self.referee.update(static_cast<int>(self.agents.size()));
  if (!(self.referee.game().teamName(TeamSide::Left) == leftBefore))
    ++self.sceneVersion;  // sides were changed
  self.serverTime += kServerCycleTime;
  self.updateMatch();
  self.listVisiblePlayers();
  // Each has its own stream of random numbers and reads of the world only what no other sense changes.
  self.world.share({self.agents.size(), [&self](std::size_t i) { self.makeSenses(*self.agents[i]); }});
}

const World& Simulation::world() const {
  return implementation_->world;
}
World& Simulation::world() {
  return implementation_->world;
}
const MatchState& Simulation::match() const {
  return implementation_->match;
}
std::span<const FoulRecord> Simulation::fouls() const {
  return implementation_->referee.fouls();
}
std::uint64_t Simulation::sceneVersion() const {
  return implementation_->sceneVersion;
}

bool Simulation::trainer(std::string_view message) {
  const Trainer::Outcome outcome = implementation_->trainer.execute(message);
  for (const AgentHandle agent : outcome.killed) {
    // The server leaves the connection open and repeats the last message for ever; here the agent is
    // disconnected.
    spdlog::info("trainer: agent {} is killed", agent);
    disconnect(agent);
  }
  if (outcome.fullState) ++implementation_->sceneVersion;
  implementation_->updateMatch();
  return !outcome.endSimulation;
}

}  // namespace nonet::sim
