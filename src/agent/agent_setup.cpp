#include "nonet/agent/agent_setup.h"

#include <array>
#include <filesystem>

#include <nlohmann/json.hpp>

#include "nonet/config/parameters.h"
#include "nonet/math/random.h"

namespace nonet::agent {
namespace {

constexpr std::string_view kStartMark = "start ";  // x, y in m, heading in rad, own field frame

}  // namespace

AgentConfig makeAgentConfig(const AgentChoice& choice, const std::string& dataFolder) {
  AgentConfig config;
  config.unum = choice.unum;
  config.team = choice.team;
  config.robotType = choice.robotType;
  config.seed = choice.seed;
  config.skillFolder = dataFolder + "/skills";
  config.parameters.motion.skills = motion::declareSkillParameters(config.skillFolder);
  config.startPose = choice.startPose;
  const std::string typeFile = dataFolder + "/params/type" + std::to_string(choice.robotType) + ".toml";
  if (choice.learned && std::filesystem::exists(typeFile)) config::overlayFile(config.parameters, typeFile);
  for (const std::string& file : choice.parameterFiles) config::overlayFile(config.parameters, file);
  return config;
}

protocol::LogHeader logHeader(const AgentConfig& config, const std::string& version) {
  protocol::LogHeader header;
  header.version = version;
  header.team = config.team;
  header.unum = config.unum;
  header.robotType = config.robotType;
  header.seed = config.seed;
  header.parameters = config::toToml(config.parameters);
  return header;
}

AgentConfig agentFromLog(const protocol::LogHeader& header, const std::string& dataFolder) {
  AgentConfig config;
  config.unum = header.unum;
  config.team = header.team;
  config.robotType = header.robotType;
  config.seed = header.seed;
  config.skillFolder = dataFolder + "/skills";
  config.parameters.motion.skills = motion::declareSkillParameters(config.skillFolder);
  config::overlayText(config.parameters, header.parameters, "header of the log");
  return config;
}

std::string startComment(const Pose2& start) {
  return std::string(kStartMark) +
         nlohmann::json{start.translation.x(), start.translation.y(), start.rotation}.dump();
}

std::optional<Pose2> startFromComment(std::string_view comment) {
  if (!comment.starts_with(kStartMark)) return std::nullopt;
  const auto values = nlohmann::json::parse(comment.substr(kStartMark.size()), nullptr, false);
  if (!values.is_array() || values.size() != 3) return std::nullopt;
  return Pose2(values[0].get<double>(), values[1].get<double>(), values[2].get<double>());
}

std::uint64_t agentSeed(std::uint64_t matchSeed, bool rightTeam, int unum) {
  return Random(matchSeed).fork(static_cast<std::uint64_t>(unum) + (rightTeam ? 100U : 0U)).next();
}

int usualRobotType(int unum) {
  constexpr std::array<int, 12> kTypes = {0, 0, 4, 4, 1, 1, 0, 3, 4, 4, 2, 3};
  return kTypes.at(static_cast<std::size_t>(unum));
}

}  // namespace nonet::agent
