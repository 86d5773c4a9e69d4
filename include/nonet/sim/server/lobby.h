// How whole teams enter a simulation reproducibly. Agents arrive in any order and at any time; each plays its
// handshake (scene, a sense message, init) against a small world of its own, and when all are there they
// enter the real one together, sorted by team and number. Nothing of the arrival order is left in what they
// sense.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "nonet/sim/simulation.h"

namespace nonet::sim {

/// The handshake of one agent.
class Lobby {
 public:
  Lobby(const Settings& settings, std::uint64_t seed) : settings_(settings), seed_(seed) {
    settings_.threads = 1;  // for one robot
    settings_.threadPatience = 0;
  }

  /// One message of the agent. Returns the sense message to answer with; nullptr if there is none (no scene
  /// has come yet, or init has: then the agent waits for the match). Valid until the next call.
  const protocol::Percept* receive(const protocol::Effectors& message);
  /// Scene and init have come.
  bool ready() const { return init_.has_value(); }
  const std::optional<protocol::SceneEffector>& scene() const { return scene_; }
  const std::optional<protocol::InitEffector>& init() const { return init_; }

 private:
  Settings settings_;
  std::uint64_t seed_;
  std::unique_ptr<Simulation> world_;
  AgentHandle agent_ = kNoAgent;
  std::optional<protocol::SceneEffector> scene_;
  std::optional<protocol::InitEffector> init_;
  bool told_ = false;  // that there is no such robot
};

/// The order in which these players enter: settings.leftTeam first, or else the team whose name is first in
/// the alphabet (it will be the left one); within a team by number, "any number" (0) last. Indices into
/// `players`.
std::vector<std::size_t> entryOrder(const Settings& settings,
                                    std::span<const protocol::InitEffector> players);

}  // namespace nonet::sim
