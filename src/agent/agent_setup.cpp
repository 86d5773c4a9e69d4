#include "nonet/agent/agent_setup.h"

#include <array>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "nonet/agent/data_folder.h"
#include "nonet/config/assignment.h"
#include "nonet/config/parameters.h"
#include "nonet/math/random.h"
#include "nonet/motion/skill_language.h"
#include "nonet/motion/skill_library.h"

namespace nonet::agent {
namespace {

constexpr const char* kChallengeOption = "challenge";
constexpr const char* kSyncOption = "sync";  // only if it is off
constexpr const char* kSyncOff = "off";
constexpr const char* kSkillOption = "skill";
constexpr const char* kSideOption = "skillSide";   // "right" if it is mirrored
constexpr std::string_view kStartMark = "start ";  // x, y in m, heading in rad, own field frame

// Without its data an agent would play on, crippled: without kicks and rises, at half the speed.
std::string skillFolderIn(const std::string& dataFolder) {
  std::string folder = dataFolder + "/skills";
  if (!motion::skillFiles(folder).empty()) return folder;
  throw DataError(folder + ": there are no skills (*.skl): is this the folder of Nonet's data?");
}

std::string learnedFileIn(const std::string& dataFolder, int robotType) {
  std::string file = dataFolder + "/params/type" + std::to_string(robotType) + ".toml";
  if (std::filesystem::exists(file)) return file;
  throw DataError(file + ": is missing: it holds the learned values of robot type " +
                  std::to_string(robotType));
}

motion::PlaySkill skillOf(const AgentSettings& settings, const std::string& name, bool mirrored) {
  const motion::SkillLibrary library(settings.skillFolder, settings.parameters.motion.skills);
  motion::PlaySkill skill;
  if (library.find(name) < 0 || !skill.name.assign(name))
    throw motion::SkillError(
        fmt::format("{}: there is no skill '{}' in this folder", settings.skillFolder, name));
  skill.side = mirrored ? model::Side::Right : model::Side::Left;
  return skill;
}

}  // namespace

AgentSettings makeAgentSettings(const AgentChoice& choice, const std::string& dataFolder) {
  AgentSettings settings;
  settings.unum = choice.unum;
  settings.team = choice.team;
  settings.robotType = choice.robotType;
  settings.seed = choice.seed;
  settings.skillFolder = skillFolderIn(dataFolder);
  settings.parameters.motion.skills = motion::declareSkillParameters(settings.skillFolder);
  settings.startPose = choice.startPose;
  settings.challenge = choice.challenge;
  if (choice.learned) {
    config::overlayFile(settings.parameters, learnedFileIn(dataFolder, choice.robotType));
  }
  for (const std::string& file : choice.parameterFiles) config::overlayFile(settings.parameters, file);
  for (const std::string& text : choice.assignments) config::assignParameter(settings.parameters, text);
  if (!choice.skill.empty()) settings.skill = skillOf(settings, choice.skill, choice.mirrorSkill);
  return settings;
}

protocol::LogHeader logHeader(const AgentSettings& settings, const std::string& version, bool sync) {
  protocol::LogHeader header;
  header.version = version;
  header.team = settings.team;
  header.unum = settings.unum;
  header.robotType = settings.robotType;
  header.seed = settings.seed;
  header.parameters = config::toToml(settings.parameters);
  if (!sync) header.options[kSyncOption] = kSyncOff;
  if (settings.challenge != team::Challenge::None)
    header.options[kChallengeOption] = team::challengeName(settings.challenge);
  if (settings.skill) {
    header.options[kSkillOption] = settings.skill->name.view();
    header.options[kSideOption] = settings.skill->side == model::Side::Right ? "right" : "left";
  }
  return header;
}

bool syncFromLog(const protocol::LogHeader& header) {
  const auto sync = header.options.find(kSyncOption);
  return sync == header.options.end() || sync->second != kSyncOff;
}

AgentSettings agentFromLog(const protocol::LogHeader& header, const std::string& dataFolder,
                           const std::string& path) {
  if (header.robotType < 0 || header.robotType > 4 || header.unum < 0 || header.unum > 11) {
    throw protocol::LogError(path + ": the header makes no sense: robot type " +
                             std::to_string(header.robotType) + ", number " + std::to_string(header.unum));
  }
  AgentSettings settings;
  settings.unum = header.unum;
  settings.team = header.team;
  settings.robotType = header.robotType;
  settings.seed = header.seed;
  if (const auto option = header.options.find(kChallengeOption); option != header.options.end())
    settings.challenge = team::challengeFromName(option->second).value_or(team::Challenge::None);
  settings.skillFolder = skillFolderIn(dataFolder);
  settings.parameters.motion.skills = motion::declareSkillParameters(settings.skillFolder);
  config::overlayText(settings.parameters, header.parameters, path + ": parameters in the header");
  if (const auto skill = header.options.find(kSkillOption); skill != header.options.end()) {
    const auto side = header.options.find(kSideOption);
    settings.skill =
        skillOf(settings, skill->second, side != header.options.end() && side->second == "right");
  }
  return settings;
}

std::string startComment(const Pose2& start) {
  return std::string(kStartMark) +
         nlohmann::json{start.translation.x(), start.translation.y(), start.rotation}.dump();
}

std::optional<Pose2> startFromComment(std::string_view comment) {
  if (!comment.starts_with(kStartMark)) return std::nullopt;
  const auto values = nlohmann::json::parse(comment.substr(kStartMark.size()), nullptr, false);
  if (!values.is_array() || values.size() != 3) return std::nullopt;
  for (const auto& value : values) {
    if (!value.is_number()) return std::nullopt;
  }
  return Pose2(values[0].get<double>(), values[1].get<double>(), values[2].get<double>());
}

std::uint64_t agentSeed(std::uint64_t matchSeed, bool rightTeam, int unum) {
  return Random(matchSeed).fork(static_cast<std::uint64_t>(unum) + (rightTeam ? 100U : 0U)).next();
}

int usualRobotType(int unum) {
  constexpr std::array<int, 12> kTypes = {0, 0, 2, 2, 2, 2, 2, 2, 2, 4, 1, 3};
  return kTypes.at(static_cast<std::size_t>(unum));
}

}  // namespace nonet::agent
