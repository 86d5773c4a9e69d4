#include "nonet/lab/trial/game_trial.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "nonet/agent/agent_setup.h"
#include "nonet/lab/trial/push.h"
#include "nonet/lab/trial/true_pose.h"
#include "nonet/math/random.h"

#include "lab/trial/trial_server.h"

namespace nonet::lab {

namespace {

constexpr std::uint64_t kSightStream = 11;
constexpr double kPreparation = 2.0;  // s from entering to the trial: beam, stand, one look about
constexpr const char* kLeftName = "Nonet";
constexpr const char* kRightName = "Guests";

/// The same place as seen by that player's team, which knows itself on the left.
Pose2 inOwnField(const GamePlayer& player) {
  return player.rightTeam ? Pose2(0.0, 0.0, kPi) * player.X_WR : player.X_WR;
}

agent::AgentSettings settingsOf(const GamePlayer& player, int unum, std::uint64_t seed) {
  agent::AgentSettings agentSettings = player.agent;
  agentSettings.unum = unum;
  agentSettings.team = player.rightTeam ? kRightName : kLeftName;
  agentSettings.startPose = inOwnField(player);
  agentSettings.seed = agent::agentSeed(seed, player.rightTeam, unum);
  return agentSettings;
}

// A robot that has itself beamed to its place before the trial and does then what its mind wants.
class Puppet {
 public:
  Puppet(const agent::AgentSettings& agentSettings, Mind mind)
      : robot_(agent::robotSettings(agentSettings)),
        start_(*agentSettings.startPose),
        mind_(std::move(mind)) {}

  const protocol::Effectors& step(const protocol::Percept& percept) {
    const world::WorldState& world = robot_.sense(percept);
    effectors_.clear();
    robot_.act(decide(world), effectors_);
    return effectors_;
  }
  const world::WorldState& world() const { return robot_.world(); }

 private:
  team::Action decide(const world::WorldState& world) {
    if (world.game.phase != world::Phase::BeforeKickOff) return mind_(world, robot_.motion().state());
    team::Action action;
    if (!beamed_ && world.game.unum != 0) {
      action.beam = start_;
      beamed_ = true;
    }
    return action;
  }

  agent::Robot robot_;
  protocol::Effectors effectors_;
  Pose2 start_;
  Mind mind_;
  bool beamed_ = false;
};

struct Entry {
  sim::AgentHandle handle = sim::kNoAgent;
  sim::RobotHandle robot = sim::kNoRobot;
  bool rightTeam = false;
  int unum = 0;
  std::variant<std::unique_ptr<agent::Agent>, std::unique_ptr<Puppet>> mind;
};

sim::Settings prepared(sim::Settings settings) {
  settings.leftTeam = kLeftName;
  settings.rightTeam = kRightName;
  return trialServer(std::move(settings), kPreparation);
}

}  // namespace

struct GameTrial::Implementation {
  Implementation(const sim::Settings& settings, const GameSituation& situation, std::uint64_t seed)
      : simulation(prepared(settings), seed) {
    std::array<int, 2> numbers{};
    for (const GamePlayer& player : situation.players) {
      int& last = numbers[player.rightTeam ? 1 : 0];
      last = player.agent.unum > 0 ? player.agent.unum : last + 1;
      enter(player, settingsOf(player, last, seed));
    }
    simulation.step();
    learnRobots();
  }

  void enter(const GamePlayer& player, const agent::AgentSettings& agentSettings) {
    protocol::SceneEffector scene;
    scene.robotType = agentSettings.robotType;
    protocol::InitEffector init;
    init.unum = agentSettings.unum;
    init.team.assign(agentSettings.team);
    Entry entry;
    entry.handle = simulation.enter(scene, init);
    entry.rightTeam = player.rightTeam;
    entry.unum = agentSettings.unum;
    if (player.mind) {
      entry.mind = std::make_unique<Puppet>(agentSettings, player.mind);
    } else {
      entry.mind = std::make_unique<agent::Agent>(agentSettings);
    }
    entries.push_back(std::move(entry));
  }

  void learnRobots() {
    for (const sim::AgentInfo& info : simulation.agents()) {
      const auto entry = std::find_if(entries.begin(), entries.end(),
                                      [&](const Entry& other) { return other.handle == info.handle; });
      if (info.unum == 0) {
        throw std::runtime_error(
            fmt::format("the referee refuses number {} of the {} team, robot type {} (numbers 1 to 11, each "
                        "once; at most "
                        "7 of a type)",
                        entry->unum, entry->rightTeam ? "right" : "left", info.robotType));
      }
      entry->robot = info.robot;
    }
  }

  void step() {
    for (Entry& entry : entries) {
      const protocol::Percept* percept = simulation.sense(entry.handle);
      if (percept == nullptr) continue;
      const protocol::Effectors& answer = std::visit(
          [&](auto& mind) -> const protocol::Effectors& { return mind->step(*percept); }, entry.mind);
      if (!answer.init) {
        simulation.act(entry.handle, answer);
        continue;
      }
      protocol::Effectors entered = answer;  // its number it has already
      entered.init.reset();
      simulation.act(entry.handle, entered);
    }
    simulation.step();
    ++cycles;
  }

  void throwBall(const Vector3& place, const Vector3& velocity) {
    simulation.trainer(fmt::format("(ball (pos {} {} {})(vel {} {} {}))", place.x(), place.y(), place.z(),
                                   velocity.x(), velocity.y(), velocity.z()));
  }

  void putBall(const GameSituation& situation, const Vector2& velocity) {
    throwBall({situation.ball.x(), situation.ball.y(), simulation.settings().ballRadius},
              {velocity.x(), velocity.y(), 0.0});
  }

  // The ball lies where it will be: before the kick-off the referee puts it back to the centre spot. In play
  // nobody knows when in a step the next sight comes: so it is here.
  void prepare(const GameSituation& situation, std::uint64_t seed) {
    const auto later = static_cast<long>(Random(seed).fork(kSightStream).below(3));
    const long preparation = std::lround(kPreparation / kCycleTime) + later;
    for (long i = 0; i < preparation; ++i) {
      putBall(situation, Vector2::Zero());
      step();
    }
  }

  void setPlayMode(protocol::PlayMode playMode) {
    simulation.trainer(fmt::format("(playMode {})", protocol::playModeName(playMode)));
  }

  // From here on it counts.
  void begin(const GameSituation& situation) {
    putBall(situation, situation.ballVelocity);
    setPlayMode(situation.playMode);
    cycles = 0;
    foulsBefore = simulation.fouls().size();
  }

  sim::Simulation simulation;
  std::vector<Entry> entries;
  long cycles = 0;
  std::size_t foulsBefore = 0;
};

GameTrial::GameTrial(const sim::Settings& settings, const GameSituation& situation, std::uint64_t seed)
    : implementation_(std::make_unique<Implementation>(settings, situation, seed)) {
  implementation_->prepare(situation, seed);
  implementation_->begin(situation);
}
GameTrial::~GameTrial() = default;

void GameTrial::step() {
  implementation_->step();
}

void GameTrial::run(double seconds) {
  const long cycles = std::lround(seconds / kCycleTime);
  for (long i = 0; i < cycles; ++i) step();
}

void GameTrial::throwBall(const Vector3& place, const Vector3& velocity) {
  implementation_->throwBall(place, velocity);
}
void GameTrial::push(std::size_t player, double most, Random& random) {
  pushRobot(implementation_->simulation.world(), implementation_->entries.at(player).robot, most, random);
}
void GameTrial::setPlayMode(protocol::PlayMode playMode) {
  implementation_->setPlayMode(playMode);
}

double GameTrial::time() const {
  return static_cast<double>(implementation_->cycles) * kCycleTime;
}
Pose2 GameTrial::pose(std::size_t player) const {
  return truePose(simulation().world(), implementation_->entries.at(player).robot);
}
double GameTrial::tilt(std::size_t player) const {
  return trueTilt(simulation().world(), implementation_->entries.at(player).robot);
}
bool GameTrial::down(std::size_t player) const {
  return isDown(simulation().world(), implementation_->entries.at(player).robot);
}
Vector3 GameTrial::ball() const {
  return simulation().world().ballPosition().cast<double>();
}
Vector3 GameTrial::ballVelocity() const {
  return simulation().world().ballVelocity().cast<double>();
}

int GameTrial::fouls(std::size_t player, sim::FoulType type) const {
  const Entry& entry = implementation_->entries.at(player);
  const auto side = entry.rightTeam ? protocol::TeamSide::Right : protocol::TeamSide::Left;
  const auto fouls = simulation().fouls().subspan(implementation_->foulsBefore);
  return static_cast<int>(std::count_if(fouls.begin(), fouls.end(), [&](const sim::FoulRecord& foul) {
    return foul.type == static_cast<int>(type) && foul.side == side && foul.unum == entry.unum;
  }));
}

const sim::Simulation& GameTrial::simulation() const {
  return implementation_->simulation;
}
const world::WorldState& GameTrial::belief(std::size_t player) const {
  return std::visit([](const auto& mind) -> const world::WorldState& { return mind->world(); },
                    implementation_->entries.at(player).mind);
}
const team::Action& GameTrial::action(std::size_t player) const {
  return std::get<std::unique_ptr<agent::Agent>>(implementation_->entries.at(player).mind)->action();
}

}  // namespace nonet::lab
