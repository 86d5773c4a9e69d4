// nonet skill play: tries a skill or kick on the embedded simulation.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include "nonet/agent/agent_setup.h"
#include "nonet/app/agent_options.h"
#include "nonet/app/commands.h"
#include "nonet/app/console.h"
#include "nonet/app/data_folder.h"
#include "nonet/config/assignment.h"
#include "nonet/lab/reports/skill_report.h"
#include "nonet/motion/skill_language.h"
#include "nonet/motion/skill_library.h"

namespace nonet::app {

namespace {

namespace fs = std::filesystem;

struct SkillPlayArguments {
  agent::AgentChoice choice;
  lab::SkillTrialSettings settings;
  std::string skill;  // name, or FILE.skl
  std::vector<double> ball;
  std::string data;
  std::string plot;
  bool json = false;
};

/// The skill that a file is about: the one with the file's name, or the only one.
std::string skillIn(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(fmt::format("{}: cannot be read", path.string()));
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  std::vector<std::string> names;
  const std::vector<motion::SkillText> folder = motion::skillTexts(motion::skillFolderOf(path.string()));
  for (const motion::Skill& skill : motion::parseSkills(text, path.string(), nullptr, folder))
    names.push_back(skill.name);
  if (std::find(names.begin(), names.end(), path.stem().string()) != names.end()) return path.stem().string();
  if (names.size() == 1) return names.front();
  throw std::runtime_error(
      fmt::format("{}: holds {}: name the file after the one to play", path.string(),
                  names.empty() ? "no skill" : fmt::format("{}", fmt::join(names, ", "))));
}

/// A file beside others: the folder's skills with the numbers that stand there. What was learned for the
/// skills of the data folder is not meant for these.
void useFolderOf(const fs::path& file, const agent::AgentChoice& choice, agent::AgentSettings& agent) {
  agent.skillFolder = motion::skillFolderOf(file.string());
  agent.parameters.motion.skills = motion::declareSkillParameters(agent.skillFolder);
  for (const std::string& overlay : choice.parameterFiles) config::overlayFile(agent.parameters, overlay);
  for (const std::string& text : choice.assignments) config::assignParameter(agent.parameters, text);
}

void chooseSkill(const SkillPlayArguments& arguments, lab::SkillTrialSettings& settings) {
  const std::string data = dataFolder(arguments.data);
  const fs::path file(arguments.skill);
  std::error_code ignored;
  if (file.extension() != ".skl") {
    settings.skill = arguments.skill;
    settings.agent = agent::makeAgentSettings(arguments.choice, data);
  } else if (fs::equivalent(fs::absolute(file).parent_path(), fs::path(data) / "skills", ignored)) {
    settings.skill = skillIn(file);
    settings.agent = agent::makeAgentSettings(arguments.choice, data);
  } else {
    settings.skill = skillIn(file);
    agent::AgentChoice choice = arguments.choice;
    choice.assignments.clear();  // they may name parameters of its own skills
    choice.parameterFiles.clear();
    settings.agent = agent::makeAgentSettings(choice, data);
    useFolderOf(file, arguments.choice, settings.agent);
  }
}

int run(const SkillPlayArguments& arguments) {
  spdlog::set_level(spdlog::level::warn);  // who enters the field is no news here
  lab::SkillTrialSettings settings = arguments.settings;
  chooseSkill(arguments, settings);
  if (!arguments.ball.empty()) settings.ball = Vector2(arguments.ball.at(0), arguments.ball.at(1));
  const lab::SkillTrial trial = lab::playSkill(settings);
  fmt::print("{}",
             arguments.json ? lab::skillReportJson(trial, settings) : lab::skillReportText(trial, settings));
  if (!arguments.plot.empty()) {
    writeAndName(arguments.plot, lab::skillReportSvg(trial, settings));
  }
  if (!trial.recordingError.empty()) {
    fmt::print(stderr, "nonet skill play: {}\n", trial.recordingError);
    return 1;
  }
  if (!settings.monitorLog.empty()) fmt::print(stderr, "{0}: nonet view {0}\n", settings.monitorLog);
  return 0;
}

}  // namespace

void addSkillPlayCommand(CLI::App& skillCommand, int& exitCode) {
  CLI::App* command = skillCommand.add_subcommand(
      "play", "Try a skill or kick: a robot of its own plays it once on the embedded simulation");
  const auto arguments = std::make_shared<SkillPlayArguments>();
  lab::SkillTrialSettings& settings = arguments->settings;
  command
      ->add_option("skill", arguments->skill, "Name of a skill, or a FILE.skl, which may call its neighbours")
      ->required();
  addAgentOptions(*command, arguments->choice, arguments->data);
  command->add_flag("--mirror", settings.mirrored, "Left and right exchanged: a kick with the right foot");
  command
      ->add_option(
          "--ball", arguments->ball,
          "Put the ball there, X,Y: metres ahead and to the left of the torso; a kick has its own place")
      ->delimiter(',')
      ->expected(2)
      ->check(CLI::Range(-50.0, 50.0));
  command
      ->add_option(
          "--seconds", settings.seconds,
          "Watch for so long from the begin of the skill; otherwise until all is quiet after its end")
      ->check(CLI::Range(0.02, 60.0));
  command->add_option("--plot", arguments->plot, "Draw what each joint was told and did: an SVG file");
  command->add_option("--monitor", settings.monitorLog, "Write a monitor log of every cycle, for nonet view");
  command->add_flag("--json", arguments->json, "Print JSON");
  command->footer(
      "The last posture is held at the end. Learned values of params/ hold for the skills of the data "
      "folder; a FILE.skl\nelsewhere is played with the numbers that stand in it.\n"
      "Examples:\n  nonet skill play kick_power --type 4 --monitor kick.mon --plot kick.svg\n"
      "  nonet skill play wave.skl --mirror\n  nonet skill play kick_quick --ball 0.2,0.07 --json");
  command->callback([arguments, &exitCode] { exitCode = run(*arguments); });
}

}  // namespace nonet::app
