// Saving, restoring and hashing a whole simulation.
#include <algorithm>
#include <bit>

#include "nonet/protocol/percept_text.h"

#include "sim/physics/hash.h"
#include "sim/physics/state_bytes.h"
#include "sim/simulation_implementation.h"

namespace nonet::sim {

namespace {

constexpr std::uint64_t kMagic = 0x4e6f6e6574536d33ULL;  // "NonetSm3"

// Percepts own memory; their text holds every bit of them.
void putPercept(std::vector<std::uint8_t>& out, const protocol::Percept& percept) {
  std::string text;
  protocol::writePercept(percept, text);
  putAll(out, std::vector<char>(text.begin(), text.end()));
}

void takePercept(std::span<const std::uint8_t>& in, protocol::Percept& percept) {
  std::vector<char> text;
  takeAll(in, text);
  protocol::parsePercept({text.data(), text.size()}, percept);
}

// Plain parts of an agent, in one place for both directions.
template <class Agent, class Plain>
void plainParts(Agent& agent, Plain&& plain) {
  plain(agent.handle);
  plain(agent.gone);
  plain(agent.enters);
  plain(agent.scene);
  plain(agent.init);
  plain(agent.beam);
  plain(agent.pass);
  plain(agent.sensors);
  plain(agent.ear);
  plain(agent.senseCount);
  plain(agent.robotCycles);
  plain(agent.announced);
  plain(agent.hasMade);
  plain(agent.hasSent);
}

}  // namespace

std::vector<std::uint8_t> Simulation::save() const {
  const Implementation& self = *implementation_;
  std::vector<std::uint8_t> out;
  put(out, kMagic);
  putAll(out, self.world.save());
  putAll(out, self.players);
  self.referee.save(out);
  put(out, self.random.state());
  put(out, self.nextHandle);
  put(out, self.serverTime);
  put(out, self.sceneVersion);
  put(out, self.agents.size());
  for (const auto& agent : self.agents) {
    plainParts(*agent, [&out](const auto& value) { put(out, value); });
    putAll(out, agent->inbox);
    put(out, agent->noise.state());
    put(out, agent->deafness.state());
    putPercept(out, agent->made);
    putPercept(out, agent->sent);
  }
  return out;
}

void Simulation::restore(std::span<const std::uint8_t> state) {
  Implementation& self = *implementation_;
  std::uint64_t magic = 0;
  take(state, magic);
  if (magic != kMagic) throw std::runtime_error("this is not a saved simulation state");
  std::vector<std::uint8_t> world;
  takeAll(state, world);
  self.world.restore(world);
  takeAll(state, self.players);
  for (const Player& player : self.players) {
    if (std::ranges::count(self.world.robots(), player.robot) == 0)
      throw std::runtime_error("saved simulation state is damaged");
  }
  self.referee.restore(state);
  Random::State random{};
  take(state, random);
  self.random.setState(random);
  take(state, self.nextHandle);
  take(state, self.serverTime);
  std::uint64_t savedVersion = 0;
  take(state, savedVersion);
  std::size_t count = 0;
  take(state, count);
  self.agents.clear();
  for (std::size_t i = 0; i < count; ++i) {
    auto agent = std::make_unique<Agent>();
    plainParts(*agent, [&state](auto& value) { take(state, value); });
    takeAll(state, agent->inbox);
    take(state, random);
    agent->noise.setState(random);
    take(state, random);
    agent->deafness.setState(random);
    takePercept(state, agent->made);
    takePercept(state, agent->sent);
    self.agents.push_back(std::move(agent));
  }
  if (!state.empty()) throw std::runtime_error("saved simulation state: data after its end");
  // Monitors that watch see another scene: the version must be none that they know.
  self.sceneVersion = std::max(self.sceneVersion, savedVersion) + 1;
  self.updateMatch();
}

std::uint64_t Simulation::signature() const {
  const MatchState& match = implementation_->match;
  Hash hash;
  hash.add(implementation_->world.signature());
  hash.add(std::bit_cast<std::uint32_t>(match.time));
  hash.add(std::bit_cast<std::uint32_t>(match.serverTime));
  hash.add(static_cast<std::uint64_t>(match.playMode));
  hash.add(static_cast<std::uint64_t>(match.scoreLeft));
  hash.add(static_cast<std::uint64_t>(match.scoreRight));
  return hash.value();
}

}  // namespace nonet::sim
