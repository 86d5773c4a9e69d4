// The agent is a function of its percept stream: no I/O, no clock, random numbers only from its seed.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "nonet/agent/parameters.h"
#include "nonet/agent/robot.h"
#include "nonet/protocol/effectors.h"
#include "nonet/protocol/percept.h"
#include "nonet/team/action.h"
#include "nonet/team/challenge.h"
#include "nonet/team/formation.h"
#include "nonet/world/world_state.h"

namespace nonet::agent {

struct AgentSettings {
  int unum = 0;  // 1..11, 0: the server chooses
  std::string team = "Nonet";
  int robotType = 0;  // 0..4
  std::uint64_t seed = 1;
  AgentParameters parameters;
  std::string skillFolder;         // folder of the *.skl files
  std::optional<Pose2> startPose;  // challenges: beam here instead of to the kick-off place (own field frame)
  team::Challenge challenge = team::Challenge::None;  // play this instead of a match
  std::optional<motion::PlaySkill> skill;             // or show this skill, again and again
};

/// The part of it below the team.
RobotSettings robotSettings(const AgentSettings& settings);

class Agent {
 public:
  explicit Agent(const AgentSettings& settings);
  ~Agent();

  /// What to send before the first message arrives: the scene effector.
  protocol::Effectors hello() const;

  /// One cycle. The first one asks for team and number (init). Allocates nothing in steady state. The
  /// reference stays valid until the next call. `syn` is not set: that is the transport's business.
  const protocol::Effectors& step(const protocol::Percept& percept);

  /// What it believes, for measurements and drawings.
  const world::WorldState& world() const;
  std::vector<Pose2> particles() const;  // where it holds itself possible, own field frame
  team::Role role() const;
  /// Roles of players 2 to 11 as it believes them agreed; empty before the first vote.
  const std::optional<protocol::RoleVote>& agreedRoles() const;
  /// Name of the kick that the body carries out; empty: none. Valid as long as the agent.
  std::string_view kick() const;
  /// What it decided in the last step, and why. With recordCandidates also what it weighed.
  const team::Action& action() const;
  void recordCandidates(bool on);
  const AgentSettings& settings() const;

 private:
  struct Stages;
  std::unique_ptr<Stages> stages_;
};

}  // namespace nonet::agent
