// The inside of Simulation, shared by its source files.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "nonet/math/random.h"
#include "nonet/sim/referee/referee.h"
#include "nonet/sim/referee/trainer.h"
#include "nonet/sim/sensors/hearing.h"
#include "nonet/sim/sensors/sensors.h"
#include "nonet/sim/simulation.h"

namespace nonet::sim {

// A connection. What the rules know of its robot is in Player.
struct Agent {
  AgentHandle handle = kNoAgent;
  bool gone = false;                       // its robot is removed in the next cycle
  bool enters = false;                     // by enter(): scene and init in the same cycle
  std::vector<protocol::Effectors> inbox;  // messages for the next cycle

  // Deferred effectors: the last action of the cycle counts.
  std::optional<protocol::SceneEffector> scene;
  std::optional<protocol::InitEffector> init;
  std::optional<Pose2> beam;
  bool pass = false;

  Random noise;
  Random deafness;                                   // which messages it misses, with Settings::sayLossShare
  AgentSensors sensors{Vector3f(Vector3f::Zero())};  // drawn anew when the robot is built
  Ear ear;
  int senseCount = 0;      // messages made since the connection, those before the robot included
  int robotCycles = 0;     // cycles since the robot was built
  bool announced = false;  // side and number have been told
  bool hasMade = false;
  bool hasSent = false;
  protocol::Percept made;  // at the end of the last cycle
  protocol::Percept sent;  // in the last cycle
};

struct Simulation::Implementation {
  Implementation(const Settings& s, std::uint64_t seed);

  Agent* find(AgentHandle handle);
  const Agent* find(AgentHandle handle) const;
  Player* playerOf(const Agent& agent);
  Agent& addAgent();

  void receive(Agent& agent, const protocol::Effectors& message);
  void broadcast(const Player& sender, std::string_view message);
  void executeDeferred(Agent& agent);
  void executeScene(Agent& agent);
  void buildRobot(Agent& agent, const protocol::SceneEffector& scene);
  void initialise(Agent& agent, const protocol::InitEffector& init);
  void seedFor(Agent& agent, TeamSide side, int unum) const;
  void beam(Agent& agent, const Pose2& request);
  void removeGoneAgents();
  void listVisiblePlayers();
  void makeSenses(Agent& agent);
  void updateMatch();

  Settings settings;
  Random random;  // never drawn from: the root of all streams
  World world;
  std::vector<Player> players;
  Referee referee;
  Trainer trainer;
  std::vector<std::unique_ptr<Agent>> agents;  // in the order of connection
  AgentHandle nextHandle = 0;
  float serverTime = 0.0F;
  std::uint64_t sceneVersion = 0;
  MatchState match;
  VisionField field;
  std::vector<VisiblePlayer> visible;  // in this cycle
};

}  // namespace nonet::sim
