// How an agent enters a simulation, message by message, and what it is told there.
#pragma once

#include <string>
#include <string_view>

#include "nonet/protocol/percept_text.h"
#include "nonet/sim/simulation.h"

namespace nonet::sim::test {

inline protocol::Effectors sceneMessage(int type) {
  protocol::Effectors effectors;
  effectors.scene = protocol::SceneEffector{type, {}};
  return effectors;
}
inline protocol::Effectors initMessage(int unum, std::string_view team) {
  protocol::Effectors effectors;
  effectors.init = protocol::InitEffector{unum, protocol::TeamName(team)};
  return effectors;
}

/// What the agent is told now, as the server writes it; empty where it is told nothing.
inline std::string textOf(const Simulation& simulation, AgentHandle agent) {
  const protocol::Percept* percept = simulation.sense(agent);
  std::string text;
  if (percept != nullptr) protocol::writePercept(*percept, text);
  return text;
}

/// Connects, sends scene and init as an agent does, and returns when init has been executed.
inline AgentHandle introduce(Simulation& simulation, int type, int unum, std::string_view team) {
  const AgentHandle agent = simulation.connect();
  simulation.act(agent, sceneMessage(type));
  simulation.step();
  simulation.step();
  simulation.step();
  simulation.act(agent, initMessage(unum, team));
  simulation.step();
  return agent;
}

}  // namespace nonet::sim::test
