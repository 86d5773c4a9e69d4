#include "nonet/lab/match/random_effectors.h"

#include <array>
#include <cmath>
#include <stdexcept>
#include <string_view>

#include "nonet/math/angle.h"
#include "nonet/math/random.h"
#include "nonet/protocol/effectors.h"
#include "nonet/sim/simulation.h"

namespace nonet::lab {
namespace {

using protocol::Effectors;

/// How an agent drives its joints for a while.
enum class Manner : std::uint8_t { Silent, Flail, Swing, Slam, Absurd };
constexpr int kManners = 5;
constexpr double kFastJoint = 7.0;  // rad/s, about what the motors give

struct Player {
  sim::AgentHandle handle = sim::kNoAgent;
  bool right = false;
  int unum = 0;
  int type = 0;
  Manner manner = Manner::Silent;
  int cyclesLeft = 0;  // until it changes its manner, or comes back
  bool away = false;
};

// What passes the server's parser and its rule for messages (server facts 1.7, 1.8).
constexpr std::string_view kLetters =
    "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz!#$%&*+,-./:<=>?@[]^_`{|}~";

double absurdNumber(Random& random) {
  constexpr std::array<double, 8> kNumbers = {0.0, -0.0, 1e30, -1e30, 1e-30, 3.4e38, 1e300, -1e300};
  return kNumbers[random.below(kNumbers.size())];
}

/// Robots that press each other's legs come somewhat farther over the stops than the recordings of matches
/// have seen. Those that are beamed into each other are thrown apart: then nothing is left but that all stays
/// finite and near.
/// A joint at a stop whose motor is told to leave it is held by nothing for that step (dxJointLimitMotor in
/// ODE: a hundred-thousandth of the torque). If the speed told is as good as none (1e-30), a toe of 22 g
/// turns by up to half a turn when its foot is jerked away in that step, and is thrown back in the next one.
sim::InvariantLimits limits(bool beams) {
  sim::InvariantLimits limits;
  limits.overshoot = beams ? 2.0 * kPi : 0.6;
  limits.toeOvershoot = 2.0 * kPi;
  limits.lowestCentre = beams ? -1.0 : -0.1;
  if (!beams) return limits;
  limits.highestCentre = 100.0;
  limits.fastestBody = 1000.0;
  return limits;
}

class RandomTeams {
 public:
  explicit RandomTeams(const RandomEffectorsSettings& settings)
      : random_(settings.seed),
        simulation_(simulationSettings(settings), settings.seed),
        beams_(settings.beams),
        invariants_(limits(settings.beams)) {
    for (int unum = 1; unum <= settings.players; ++unum) {
      for (const bool right : {false, true}) {
        Player player;
        player.right = right;
        player.unum = unum;
        player.type = (unum + (right ? 2 : 0)) % model::kRobotTypeCount;
        players_.push_back(player);
      }
    }
    for (Player& player : players_) enter(player);
  }

  void cycle() {
    if (random_.below(500) == 0) trainerSpeaks();
    for (Player& player : players_) act(player);
    simulation_.step();
    invariants_.check(simulation_);
    ++result_.cycles;
    result_.violations = invariants_.violations();
  }

  RandomEffectorsResult result() const {
    RandomEffectorsResult result = result_;
    result.signature = simulation_.signature();
    result.messagesOfViolations = invariants_.messages();
    result.extremes = invariants_.extremes();
    return result;
  }
  const RandomEffectorsResult& soFar() const { return result_; }

 private:
  static sim::Settings simulationSettings(const RandomEffectorsSettings& effectors) {
    sim::Settings settings;
    settings.automaticKickOff = true;
    settings.ruleHalfTime = 60.0;
    settings.threads = effectors.threads;
    return settings;
  }

  void enter(Player& player) {
    protocol::SceneEffector scene;
    scene.robotType = player.type;
    protocol::InitEffector init;
    init.unum = player.unum;
    init.team.assign(player.right ? "Right" : "Left");
    player.handle = simulation_.enter(scene, init);
    player.away = false;
    ++result_.entered;
  }

  void act(Player& player) {
    if (--player.cyclesLeft <= 0) change(player);
    if (player.away || (player.manner == Manner::Silent && random_.below(4) == 0)) return;
    Effectors effectors;
    drive(player, effectors);
    speak(effectors);
    if (effectors.beam || effectors.scene || effectors.init) ++result_.placed;
    // As text, as over TCP.
    protocol::writeEffectors(effectors, text_);
    Effectors received;
    if (protocol::parseEffectors(text_, received) > 0) throw std::logic_error("not well-formed: " + text_);
    simulation_.actAsReceived(player.handle, received);
    ++result_.messages;
  }

  void change(Player& player) {
    player.cyclesLeft = 5 + static_cast<int>(random_.below(100));
    player.manner = static_cast<Manner>(random_.below(kManners));
    if (player.away || !simulation_.isConnected(player.handle)) {
      enter(player);
    } else if (beams_ && random_.below(60) == 0) {
      simulation_.disconnect(player.handle);
      player.away = true;
    }
  }

  void drive(const Player& player, Effectors& effectors) {
    const double time = static_cast<double>(result_.cycles) * kCycleTime;
    for (std::size_t i = 0; i < model::kJointCount; ++i) {
      if (random_.below(3) == 0) continue;
      const double sign = random_.below(2) == 0 ? 1.0 : -1.0;
      double speed = 0.0;
      if (player.manner == Manner::Flail) speed = random_.uniform(-kFastJoint, kFastJoint);
      if (player.manner == Manner::Swing) speed = kFastJoint * std::sin(8.0 * time + static_cast<double>(i));
      if (player.manner == Manner::Slam) speed = 10.0 * kFastJoint * (i % 2 == 0 ? 1.0 : -1.0);
      if (player.manner == Manner::Absurd) speed = sign * absurdNumber(random_);
      effectors.setSpeed(model::jointAt(i), speed);
    }
  }

  void speak(Effectors& effectors) {
    if (beams_ && random_.below(20) == 0) {
      const bool absurd = random_.below(4) == 0;
      const double x = absurd ? absurdNumber(random_) : random_.uniform(-16.0, 16.0);
      const double y = absurd ? absurdNumber(random_) : random_.uniform(-11.0, 11.0);
      effectors.beam = Pose2(x, y, random_.uniform(-4.0, 4.0));
    }
    if (random_.below(4) == 0) {
      std::string words(1 + random_.below(protocol::kMaxSayLength), 'a');
      for (char& c : words) c = kLetters[random_.below(kLetters.size())];
      effectors.say.emplace().assign(words);
    }
    effectors.pass = random_.below(50) == 0;
    effectors.syn = random_.below(2) == 0;
    if (beams_ && random_.below(200) == 0)
      effectors.scene.emplace().robotType = static_cast<int>(random_.below(5));
    // A second init, also a refused one, puts the robot on the next start position (server facts 1.3): after
    // some hundreds of them these are in the wall around the field.
    if (beams_ && random_.below(200) == 0) {
      protocol::InitEffector& init = effectors.init.emplace();
      init.unum = static_cast<int>(random_.below(13));
      init.team.assign(random_.below(2) == 0 ? "Left" : "Third");
    }
  }

  void trainerSpeaks() {
    constexpr std::array<const char*, 8> kCommands = {"(playMode PlayOn)",
                                                      "(playMode KickOff_Left)",
                                                      "(playMode corner_kick_right)",
                                                      "(dropBall)",
                                                      "(playMode BeforeKickOff)",
                                                      "(kickOff None)",
                                                      "(ball (pos 0 0 0.042))",
                                                      "(ball (vel 5 -4 6))"};
    simulation_.trainer(kCommands[random_.below(kCommands.size())]);
  }

  Random random_;
  sim::Simulation simulation_;
  bool beams_;
  sim::Invariants invariants_;
  std::vector<Player> players_;
  RandomEffectorsResult result_;
  std::string text_;
};

}  // namespace

RandomEffectorsResult playRandomEffectors(const RandomEffectorsSettings& settings,
                                          const std::function<bool(const RandomEffectorsResult&)>& goOn) {
  RandomTeams teams(settings);
  const long cycles = std::lround(settings.minutes * 60.0 / kCycleTime);
  bool more = true;
  while (teams.soFar().cycles < cycles && more) {
    teams.cycle();
    more = goOn(teams.soFar());
  }
  RandomEffectorsResult result = teams.result();
  result.stopped = !more;
  return result;
}

}  // namespace nonet::lab
