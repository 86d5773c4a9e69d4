#include "nonet/sim/server/lobby.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

#include <spdlog/spdlog.h>

namespace nonet::sim {

const protocol::Percept* Lobby::receive(const protocol::Effectors& message) {
  if (ready()) return nullptr;
  if (!scene_) {
    if (!message.scene) return nullptr;
    if (!typeOf(*message.scene)) {
      if (!std::exchange(told_, true))
        spdlog::warn("lobby: there is no robot type {} in that scene file", message.scene->robotType);
      return nullptr;  // it may try again
    }
    scene_ = message.scene;
    world_ = std::make_unique<Simulation>(settings_, seed_);
    agent_ = world_->connect();
    protocol::Effectors scene;
    scene.scene = scene_;
    world_->actAsReceived(agent_, scene);
    world_->step();  // builds the robot
    world_->step();  // makes its first message
    world_->step();  // sends it
    return world_->sense(agent_);
  }
  if (message.init) {
    init_ = message.init;
    world_.reset();
    return nullptr;
  }
  world_->actAsReceived(agent_, message);
  world_->step();
  return world_->sense(agent_);
}

std::vector<std::size_t> entryOrder(const Settings& settings,
                                    std::span<const protocol::InitEffector> players) {
  const auto key = [&](std::size_t i) {
    const protocol::InitEffector& player = players[i];
    const std::string_view team = player.team;
    const int rank = team == settings.leftTeam ? 0 : team == settings.rightTeam ? 2 : 1;
    return std::tuple(rank, team, player.unum == 0 ? 1 : 0, player.unum);
  };
  std::vector<std::size_t> order(players.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  return order;
}

}  // namespace nonet::sim
