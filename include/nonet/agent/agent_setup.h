// From choices on a command line, or the header of a log, to a complete agent configuration.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "nonet/agent/agent.h"
#include "nonet/protocol/log_file.h"

namespace nonet::agent {

struct AgentChoice {
  int unum = 0;  // 1..11, 0: the server chooses
  std::string team = "Nonet";
  int robotType = 0;  // 0..4
  std::uint64_t seed = 1;
  bool learned = true;                      // begin with params/type<robotType>.toml
  std::vector<std::string> parameterFiles;  // overlaid in this order
  std::vector<std::string> assignments;     // single parameters, "team.ball.kick=false", set last
  std::optional<Pose2> startPose;           // own field frame
  team::Challenge challenge = team::Challenge::None;
  std::string skill;         // name of a skill to show instead of playing; empty: none
  bool mirrorSkill = false;  // left and right exchanged
};

/// Parameters are layered: defaults of the code, then DATA/params/type<robotType>.toml, then the given files,
/// then the assignments. `dataFolder` holds params/ and skills/. Throws config::ParameterError; DataError,
/// one of these, if the file of the type or all skills are missing.
AgentSettings makeAgentSettings(const AgentChoice& choice, const std::string& dataFolder);

/// What the header of a log must hold so that agentFromLog() builds the same agent. `sync` is the session's.
protocol::LogHeader logHeader(const AgentSettings& settings, const std::string& version, bool sync = true);
/// Whether the agent's answers ended with (syn).
bool syncFromLog(const protocol::LogHeader& header);

/// The same agent as the one that wrote the header of the log `path`. The start pose stands in a comment of
/// its own. Throws protocol::LogError or config::ParameterError that name `path`.
AgentSettings agentFromLog(const protocol::LogHeader& header, const std::string& dataFolder,
                           const std::string& path);
std::string startComment(const Pose2& start);
std::optional<Pose2> startFromComment(std::string_view comment);

/// The seed of one agent of a match: the match's seed and the agent decide, so no two agents draw the same
/// numbers.
std::uint64_t agentSeed(std::uint64_t matchSeed, bool rightTeam, int unum);

/// Robot types by uniform number (index 0 unused), such that any first n of a team pass the server's type
/// rules (facts 1.4). The same list is in scripts/start.sh.
int usualRobotType(int unum);

}  // namespace nonet::agent
