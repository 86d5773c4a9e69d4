// A whole server without sockets: the world, the agents' sensors and effectors, hearing, clock and referee.
// The TCP server and in-process matches are thin shells around it. Cycle order: server facts 1.2.
//
// An in-process agent is a loop of sense(), act(), step(). It meets the server's latency: what is sent in
// answer to message k is applied in the step after the one that made message k+1, so its effect shows in
// message k+2.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "nonet/protocol/effectors.h"
#include "nonet/protocol/percept.h"
#include "nonet/sim/physics/world.h"
#include "nonet/sim/referee/player.h"
#include "nonet/sim/settings/settings.h"

namespace nonet::sim {

struct AgentInfo {
  AgentHandle handle = kNoAgent;
  RobotHandle robot = kNoRobot;
  protocol::TeamSide side = protocol::TeamSide::None;
  int unum = 0;  // 0: not (or not successfully) initialised
  int robotType = 0;
  protocol::TeamName team;
  bool selected = false;  // by the trainer
};

struct MatchState {
  protocol::PlayMode playMode = protocol::PlayMode::BeforeKickOff;
  float time = 0.0F;        // game time, s
  float serverTime = 0.0F;  // s since start
  int half = 1;
  int scoreLeft = 0;
  int scoreRight = 0;
  protocol::TeamName teamLeft;
  protocol::TeamName teamRight;
  float passModeScoreWaitLeft = 0.0F;  // s for which the left team may not score after its pass mode
  float passModeScoreWaitRight = 0.0F;
};

/// The robot type that a scene message asks for: nao.rsg is type 0, whatever follows. Nothing if there is no
/// such description or type.
std::optional<int> typeOf(const protocol::SceneEffector& scene);

class Simulation {
 public:
  explicit Simulation(const Settings& settings, std::uint64_t seed = 1);
  ~Simulation();
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  const Settings& settings() const;

  // -- agents
  /// An agent that will send scene and init itself. Its noise depends on the seed and, after init, on side
  /// and number.
  AgentHandle connect();
  /// A player whose robot is built and initialised in one go in the next cycle, at its start position. All
  /// its noise depends only on seed, side and number: whoever enters whole teams in a fixed order has a
  /// reproducible match, however late or early the agents arrived. A refusal (server facts 1.3) shows as unum
  /// 0 in agents().
  AgentHandle enter(const protocol::SceneEffector& scene, const protocol::InitEffector& init);
  /// The robot is removed in the next cycle.
  void disconnect(AgentHandle agent);
  /// False after disconnect(), and once a trainer has killed the agent.
  bool isConnected(AgentHandle agent) const;
  /// One message of an agent, processed in the next cycle: agents in the order in which they connected,
  /// messages of one agent in the order of the calls. Numbers are rounded as text would round them, so that
  /// in-process and TCP matches are the same; `syn` is the server's business. Unknown or disconnected agents
  /// are ignored.
  void act(AgentHandle agent, const protocol::Effectors& effectors);
  /// The same for effectors that were read from text.
  void actAsReceived(AgentHandle agent, const protocol::Effectors& effectors);
  /// The message that the server sent in the last cycle (it was made at the end of the cycle before); false
  /// if there was none, because the agent has no robot or got it less than two cycles ago. The values equal
  /// those of the text to the last bit.
  bool sense(AgentHandle agent, protocol::Percept& percept) const;
  /// The same without a copy; nullptr if there was none. Valid until the next step.
  const protocol::Percept* sense(AgentHandle agent) const;
  std::vector<AgentInfo> agents() const;

  // -- time
  /// One cycle of 20 ms: commands, pre-physics, physics, clock and referee, senses.
  void step();
  /// The two halves of step(): beginCycle() reads the commands and hands out the messages of the cycle
  /// before; finishCycle() does the rest. A server in real time sends between the two. What does not touch
  /// the simulation, such as agents that think about those messages, may go on alongside, on its threads.
  void beginCycle();
  void finishCycle(const SharedWork& alongside = {});

  // -- truth, for the monitor stream, tasks and tests
  const World& world() const;
  World& world();
  const MatchState& match() const;
  std::span<const FoulRecord> fouls() const;  // all since the start
  /// Changes whenever monitors need a full scene: a robot came, went or was initialised, sides changed, or
  /// somebody asked for it.
  std::uint64_t sceneVersion() const;

  // -- trainer (server facts 5.5)
  /// Executes the trainer commands in one message; unknown ones are ignored. Returns false if `(killsim)` was
  /// among them.
  bool trainer(std::string_view message);

  // -- state
  /// Everything, if no cycle is under way (between beginCycle() and finishCycle() some commands are in
  /// neither part): restoring it into a simulation with the same settings continues bit-exactly, agents'
  /// handles included.
  std::vector<std::uint8_t> save() const;
  /// Throws std::runtime_error if `state` has another format, length, count or name of a part than a saved
  /// one; the simulation is then good for nothing but another restore(). Other damage is not noticed.
  void restore(std::span<const std::uint8_t> state);
  /// Hash of world, clock, scores and play mode, for determinism checks.
  std::uint64_t signature() const;

  struct Implementation;

 private:
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace nonet::sim
