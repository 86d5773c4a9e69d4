// A whole server without sockets: the world, the agents' sensors and effectors, hearing, clock and referee.
// The TCP server and in-process matches are thin shells around it. Cycle order: server facts 1.2.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "nonet/protocol/effectors.h"
#include "nonet/protocol/percept.h"
#include "nonet/sim/settings.h"
#include "nonet/sim/world.h"

namespace nonet::sim {

/// A connected agent. Never reused within a simulation.
using AgentHandle = int;

struct AgentInfo {
  AgentHandle handle = -1;
  RobotHandle robot = kNoRobot;
  protocol::TeamSide side = protocol::TeamSide::None;
  int unum = 0;  // 0: not (or not successfully) initialised
  int robotType = 0;
  protocol::TeamName team;
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
};

struct FoulRecord {
  int index = 0;  // from 1
  int type = 0;   // numbers of server facts 4.10
  protocol::TeamSide side = protocol::TeamSide::None;
  int unum = 0;
};

class Simulation {
 public:
  explicit Simulation(const Settings& settings, std::uint64_t seed = 1);
  ~Simulation();

  const Settings& settings() const;

  // -- agents
  // ---------------------------------------------------------------------------------------------------
  AgentHandle connect();
  void disconnect(AgentHandle agent);
  /// One message of an agent, processed in the next cycle in the order of the calls. `syn` is the server's
  /// business.
  void act(AgentHandle agent, const protocol::Effectors& effectors);
  /// The sense message generated at the end of the last cycle; false while the agent has no robot.
  /// The values equal those of the text to the last bit. `withText` false skips what only text needs (the
  /// order).
  bool sense(AgentHandle agent, protocol::Percept& percept);
  std::vector<AgentInfo> agents() const;

  // -- time
  // -----------------------------------------------------------------------------------------------------
  /// One cycle of 20 ms: commands, pre-physics, physics, clock and referee, senses.
  void step();

  // -- truth, for the monitor stream, tasks and tests
  // -------------------------------------------------------------
  const World& world() const;
  World& world();
  const MatchState& match() const;
  std::span<const FoulRecord> fouls() const;  // all since the start

  // -- trainer (server facts 5.5)
  // ---------------------------------------------------------------------------------
  /// Executes the trainer commands in one message; unknown ones are ignored. Returns false if `(killsim)` was
  /// among them.
  bool trainer(std::string_view message);

  // -- state
  // ----------------------------------------------------------------------------------------------------
  std::vector<std::uint8_t> save() const;
  void restore(std::span<const std::uint8_t> state);
  std::uint64_t signature() const;

  struct Implementation;

 private:
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace nonet::sim
