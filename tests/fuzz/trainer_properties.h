// What must hold for any message of a trainer. Returns what is wrong, or nothing.
#pragma once

#include <cmath>
#include <string>

#include <spdlog/spdlog.h>

#include "nonet/protocol/percept_text.h"
#include "nonet/sim/simulation.h"

namespace nonet::fuzz {

/// A match of two in full play, brought back to the same state for each message.
class TrainedMatch {
 public:
  TrainedMatch() : simulation_(sim::Settings{}) {
    for (const char* team : {"L", "R"}) {
      protocol::InitEffector init;
      init.unum = 1;
      init.team.assign(team);
      agents_.push_back(simulation_.enter({}, init));
      simulation_.step();
    }
    simulation_.trainer("(playMode PlayOn)");
    for (int i = 0; i < 5; ++i) simulation_.step();
    start_ = simulation_.save();
  }

  /// A match goes on after whatever a trainer says: in reasonable numbers, and so that it can be saved.
  std::string check(std::string_view message) {
    simulation_.restore(start_);
    simulation_.trainer(message);
    for (int i = 0; i < 4; ++i) simulation_.step();
    const std::string problem = checkState();
    if (!problem.empty()) return problem;
    const auto saved = simulation_.save();
    const auto signature = simulation_.signature();
    simulation_.restore(saved);
    return simulation_.signature() == signature ? "" : "saved and restored it differs";
  }

 private:
  std::string checkState() const {
    const sim::MatchState& match = simulation_.match();
    if (!std::isfinite(match.time) || match.time < 0.0F) return "time of the game";
    if (match.scoreLeft < 0 || match.scoreRight < 0) return "score";
    if (match.half < 1 || match.half > 2) return "half";
    const sim::World& world = simulation_.world();
    if (!world.ballPosition().allFinite() || !world.ballVelocity().allFinite())
      return "the ball is not finite";
    for (const sim::AgentInfo& info : simulation_.agents()) {
      if (info.robot == sim::kNoRobot) continue;
      const auto torso = world.bodyState(info.robot, model::BodyId::Torso);
      if (!torso.position.allFinite() || !torso.velocity.allFinite()) return "a robot is not finite";
    }
    std::string text;
    for (const sim::AgentHandle agent : agents_) {
      if (const protocol::Percept* percept = simulation_.sense(agent)) protocol::writePercept(*percept, text);
    }
    return {};
  }

  sim::Simulation simulation_;
  std::vector<sim::AgentHandle> agents_;
  std::vector<std::uint8_t> start_;
};

inline std::string checkTrainer(std::string_view message) {
  spdlog::set_level(spdlog::level::off);  // it says of much that it makes no sense
  static TrainedMatch match;
  return match.check(message);
}

}  // namespace nonet::fuzz
