// What agents do to the simulation: their effectors, from the handshake (server facts 1.3) to the end of the
// connection.
#include <algorithm>
#include <array>
#include <cmath>

#include <spdlog/spdlog.h>

#include "nonet/math/angle.h"

#include "sim/simulation_implementation.h"

namespace nonet::sim {

namespace {

// + 16 * side + number
constexpr std::uint64_t kPlayerStream = 0x100;
constexpr std::uint64_t kDeafnessStream = 0x200;

constexpr std::string_view kUntypedRobot = "rsg/agent/nao/nao.rsg";
constexpr std::string_view kTypedRobot = "rsg/agent/nao/nao_hetero.rsg";

bool isKnown(const protocol::SceneEffector& scene) {
  return scene.file.empty() || scene.file == kUntypedRobot || scene.file == kTypedRobot;
}

}  // namespace

std::optional<int> typeOf(const protocol::SceneEffector& scene) {
  if (!isKnown(scene)) return std::nullopt;
  if (scene.file == kUntypedRobot) return 0;
  if (scene.robotType < 0 || scene.robotType >= model::kRobotTypeCount) return std::nullopt;
  return scene.robotType;
}

// Server facts 1.2, phase 1: immediate effectors act, deferred ones are kept.
void Simulation::Implementation::receive(Agent& agent, const protocol::Effectors& message) {
  const Player* player = playerOf(agent);
  if (message.scene) agent.scene = message.scene;
  // All other effectors come with the robot: what arrives with the scene message is lost (server facts 1.3).
  if (player == nullptr) return;
  for (std::size_t i = 0; i < model::kJointCount; ++i) {
    const model::JointId joint = model::jointAt(i);
    if (!message.hasSpeed(joint)) continue;
    const float speed = static_cast<float>(message.speeds[i]);
    if (std::isnan(speed)) {
      // The server lets it through and its physics breaks; a safe world is worth more.
      spdlog::warn("player {}: speed of {} is not a number, ignored", player->unum,
                   model::effectorName(joint));
      continue;
    }
    world.setJointSpeed(player->robot, joint, speed);
  }
  if (message.firstSay) broadcast(*player, message.firstSay->view());
  if (message.say) broadcast(*player, message.say->view());
  if (message.init) agent.init = message.init;
  if (message.beam) agent.beam = message.beam;
  agent.pass = agent.pass || message.pass;
}

// Server facts 1.7.
void Simulation::Implementation::broadcast(const Player& sender, std::string_view message) {
  if (!protocol::isSayable(message)) return;
  constexpr float kRange = 50.0F;  // m
  const Vector3f from = world.bodyPose(sender.robot, model::BodyId::Torso).position;
  for (const Player& listener : players) {
    Agent* agent = find(listener.agent);
    if (listener.agent == sender.agent) {
      agent->ear.hearSelf(message);
      continue;
    }
    if (sender.side == TeamSide::None || listener.side == TeamSide::None) continue;
    Vector3f away = from - world.bodyPosition(listener.robot, model::BodyId::Torso);
    if (away.norm() >= kRange) continue;
    if (settings.sayLossShare > 0.0 && agent->deafness.uniform() < settings.sayLossShare) continue;
    // Not relative to the listener's heading: the bearing in its team's field frame.
    if (listener.side == TeamSide::Right) away = -away;
    const float direction = static_cast<float>(std::atan2(away.y(), away.x()) * (180.0 / kPi));
    agent->ear.hearOther(message, sender.team, direction, listener.side == sender.side);
  }
}

// Effectors of robots that exist: World runs their moves at the right place of its walk through the scene.
void Simulation::Implementation::executeDeferred(Agent& agent) {
  if (playerOf(agent) == nullptr) return;
  if (agent.init) {
    initialise(agent, *agent.init);
    agent.init.reset();
  }
  if (agent.beam) {
    beam(agent, *agent.beam);
    agent.beam.reset();
  }
  if (agent.pass) {
    referee.requestPassMode(*playerOf(agent));
    agent.pass = false;
  }
}

void Simulation::Implementation::executeScene(Agent& agent) {
  if (agent.enters) {
    agent.enters = false;
    // Number and side are wanted before the robot is built, because its calibration error depends on them.
    initialise(agent, *agent.init);
    agent.init.reset();
  } else if (agent.scene) {
    buildRobot(agent, *agent.scene);
  }
  agent.scene.reset();
}

void Simulation::Implementation::buildRobot(Agent& agent, const protocol::SceneEffector& scene) {
  if (!isKnown(scene)) {
    spdlog::warn("agent {}: unknown scene file '{}'", agent.handle, std::string_view(scene.file));
    return;
  }
  const std::optional<int> type = typeOf(scene);
  if (!type) {
    spdlog::warn("agent {}: there is no robot type {}, types are 0 to {}", agent.handle, scene.robotType,
                 model::kRobotTypeCount - 1);
    return;
  }
  if (playerOf(agent) != nullptr) {
    // The server builds a second robot inside the same agent, with every perceptor twice: of no use to
    // anybody.
    spdlog::warn("agent {}: has a robot already, second scene message ignored", agent.handle);
    return;
  }
  Player player;
  player.agent = agent.handle;
  player.robot = world.addRobot(*type);
  player.robotType = *type;
  player.touchGroup = referee.newTouchGroup();
  players.push_back(player);
  // Players stay in the order in which their agents connected.
  std::sort(players.begin(), players.end(),
            [](const Player& a, const Player& b) { return a.agent < b.agent; });
  agent.sensors = AgentSensors(agent.noise);
  ++sceneVersion;
}

void Simulation::Implementation::seedFor(Agent& agent, TeamSide side, int unum) const {
  const std::uint64_t player = 16 * index(side) + static_cast<std::uint64_t>(unum);
  agent.noise = random.fork(kPlayerStream + player);
  agent.deafness = random.fork(kDeafnessStream + player);
}

// Server facts 1.3. Every init moves the robot to its side's next start position, also a refused one.
void Simulation::Implementation::initialise(Agent& agent, const protocol::InitEffector& init) {
  const bool entering = playerOf(agent) == nullptr;
  // Nobody is registered whose robot cannot be built. This says why it cannot.
  if (entering && !typeOf(*agent.scene)) return buildRobot(agent, *agent.scene);
  const int type = entering ? *typeOf(*agent.scene) : playerOf(agent)->robotType;
  TeamSide side = TeamSide::None;
  int unum = init.unum;
  const auto refusal = referee.game().registerPlayer(init.team, type, side, unum, settings);
  const bool accepted = refusal == GameState::Refusal::None;
  if (refusal == GameState::Refusal::TeamName) {
    // The name itself could break the lines of the log.
    spdlog::warn("agent {}: init as number {} refused: {}", agent.handle, init.unum,
                 "a team's name has 1 to 64 printable characters, no blank, bracket or quote");
  } else if (accepted) {
    seedFor(agent, side, unum);
    spdlog::info("agent {}: number {} of team {} ({}), robot type {}", agent.handle, unum,
                 std::string_view(init.team), sideName(side), type);
  } else {
    constexpr std::array<const char*, 5> kReasons = {
        "", "there are two teams already", "the number is taken or the team is full", "numbers are 1 to 11",
        "the rules on robot types forbid it"};
    spdlog::warn("agent {}: init as number {} of team {} with robot type {} refused: {}", agent.handle,
                 init.unum, std::string_view(init.team), type, kReasons[static_cast<std::size_t>(refusal)]);
  }
  if (entering) buildRobot(agent, *agent.scene);
  Player* player = playerOf(agent);
  if (player == nullptr) {
    referee.game().releasePlayer(side, unum, type);
    return;
  }
  if (accepted) {
    // The server forgets to give the old number back when somebody repeats init; that leak helps nobody.
    referee.game().releasePlayer(player->side, player->unum, player->robotType);
    referee.changeNumber(*player);
    player->side = side;
    player->unum = unum;
    player->team = init.team;
    ++sceneVersion;
  }
  Vector3f start = referee.game().nextStartPosition(player->side, settings);
  // A pile of those who were refused would take the physics longer than their fall.
  if (player->side == TeamSide::None) start.y() += static_cast<float>(agent.handle % 15 - 7);
  const float yaw = GameState::startYaw(player->side);
  if (entering) {
    world.placeRobot(player->robot, start, yaw);
  } else {
    world.deferPlacement(player->robot, World::DeferredBy::Init, start, yaw);
  }
}

// Server facts 4.6.
void Simulation::Implementation::beam(Agent& agent, const Pose2& request) {
  const Player& player = *playerOf(agent);
  const PlayMode mode = referee.game().playMode();
  if (mode != PlayMode::BeforeKickOff && mode != PlayMode::GoalLeft && mode != PlayMode::GoalRight) return;
  const float noiseXY = static_cast<float>(settings.beamNoiseXY);
  const float noiseAngle = static_cast<float>(settings.beamNoiseAngle);
  const auto uniform = [&agent] { return static_cast<float>(agent.noise.uniform(-1.0, 1.0)); };
  Vector3f position = Vector3f::Zero();
  position.x() = static_cast<float>(request.translation.x()) + noiseXY * uniform();
  position.y() = static_cast<float>(request.translation.y()) + noiseXY * uniform();
  float angle = static_cast<float>(toDegrees(request.rotation)) + noiseAngle * uniform();
  if (!std::isfinite(position.x()) || !std::isfinite(position.y()) || !std::isfinite(angle)) {
    spdlog::warn("player {}: beam with a number that is not finite, ignored", player.unum);
    return;
  }
  if (!settings.startAnyFieldPosition) {
    const float halfLength = static_cast<float>(settings.fieldLength) / 2.0F;
    const float halfWidth = static_cast<float>(settings.fieldWidth) / 2.0F;
    position.x() = std::clamp(position.x(), -halfLength, 0.0F);
    position.y() = std::clamp(position.y(), -halfWidth, halfWidth);
  }
  position.z() = static_cast<float>(settings.agentRadius);
  if (player.side == TeamSide::Right) position.head<2>() = -position.head<2>();
  angle += GameState::startYaw(player.side);
  world.deferPlacement(player.robot, World::DeferredBy::Beam, position, angle);
}

void Simulation::Implementation::removeGoneAgents() {
  for (const auto& agent : agents) {
    if (!agent->gone) continue;
    const Player* player = playerOf(*agent);
    if (player == nullptr) continue;
    referee.game().releasePlayer(player->side, player->unum, player->robotType);
    referee.forget(*player);
    world.removeRobot(player->robot);
    players.erase(players.begin() + (player - players.data()));
  }
  const std::size_t removed = std::erase_if(agents, [](const auto& agent) { return agent->gone; });
  if (removed > 0) ++sceneVersion;
}

}  // namespace nonet::sim
