// What must hold for any text that is read as a skill file. Returns what is wrong, or nothing.
#pragma once

#include <cmath>
#include <string>

#include <fmt/format.h>

#include "nonet/motion/skill_language.h"
#include "nonet/motion/skill_player.h"

namespace nonet::fuzz {

inline std::string describe(const std::vector<motion::Skill>& skills) {
  std::string text;
  const auto add = [&text](const motion::KickValue& value) {
    text += fmt::format("{} ", value.constant);
    for (const double per : value.per) text += fmt::format("{} ", per);
  };
  for (const motion::Skill& skill : skills) {
    text += fmt::format("skill {} {} {}\n", skill.name, skill.loopSlots, skill.conditions.size());
    for (const motion::SkillParameter& parameter : skill.parameters)
      text += fmt::format("{} {} {} {} {}\n", parameter.name, parameter.value,
                          static_cast<int>(parameter.unit), parameter.range ? parameter.range->low : 0.0,
                          parameter.range ? parameter.range->high : 0.0);
    if (skill.kick)
      text += fmt::format("kick {} {} {} {} {} {} {} {} {} {}\n", skill.kick->p_RBall.x(),
                          skill.kick->p_RBall.y(), skill.kick->direction, skill.kick->turn,
                          skill.kick->longest, skill.kick->contact, skill.kick->clears, skill.kick->low,
                          skill.kick->steady, skill.kick->types);
    for (const motion::Instruction& instruction : skill.program) {
      text +=
          fmt::format("{} {} {} {} {} {}:", static_cast<int>(instruction.kind), instruction.value,
                      instruction.target, instruction.count, instruction.calleeName, instruction.mirrored);
      add(instruction.duration);
      for (const motion::JointGoal& goal : instruction.joints) {
        text += fmt::format("{} ", static_cast<int>(goal.joint));
        add(goal.angle);
        add(goal.after);
      }
      for (const motion::FootShift& shift : instruction.shifts) {
        for (const motion::KickValue& way : shift.way) add(way);
      }
      text += "\n";
    }
  }
  return text;
}

/// Plays the first skill for a second: it may fail, but never tells a joint something that is no number.
inline std::string checkPlaying(const std::vector<motion::Skill>& skills) {
  motion::SkillLibrary library;
  try {
    library = motion::SkillLibrary(skills);
  } catch (const motion::SkillError&) {
    return {};
  }
  if (library.size() == 0) return {};
  motion::SkillPlayer player(model::robotModel(0), library);
  world::WorldState world;
  world.body.cycleTime = kCycleTime;
  motion::JointTargets targets;
  targets.stiffness.fill(1.0);
  for (const bool mirrored : {false, true}) {
    if (!player.start(library.skill(0).name, mirrored, targets.angles,
                      motion::KickAim{Vector2(0.2, 0.05), 0.1, Vector2(0.3, -0.1)}))
      return "does not start";
    for (int cycle = 0; cycle < 50; ++cycle) {
      const auto result = player.update(world, targets);
      for (const double angle : targets.angles) {
        if (!std::isfinite(angle)) return "an angle is not finite";
      }
      if (result != motion::SkillPlayer::Result::Running) break;
    }
  }
  return {};
}

/// A text parses or is refused by a line that names file and place; a formatted text means the same.
inline std::string checkSkillText(std::string_view text) {
  static const std::string kFile = "fuzz.skl";
  // A text may be like this one; what does not fit together then is told at a place in this one.
  static const std::vector<motion::SkillText> kOthers{
      {"near.skl",
       "skill near {\n  parameter x = 5deg in 0deg..9deg\n  parameter y = x * 2\n  kick { ball (0.2m, 0) "
       "distance "
       "1m..2m contact 0.1s }\n  move over 0.2s { left.knee -x left.hipRoll y * turn }\n}\n"
       "skill next like near { parameter x = 6deg }\n"}};
  const motion::SkillCheck check = motion::checkSkills(text, kFile, kOthers);
  for (const std::string& error : check.errors) {
    if (!error.starts_with(kFile + ":") && !error.starts_with(kOthers.front().file + ":"))
      return "an error without its place: " + error;
  }
  std::vector<motion::Skill> skills;
  try {
    skills = motion::parseSkills(text, kFile, nullptr, kOthers);
  } catch (const motion::SkillError& error) {
    return check.errors.empty() ? fmt::format("the check does not find: {}", error.what()) : "";
  }
  if (check.errors.empty() && describe(check.skills) != describe(skills))
    return "the check reads something else";
  const std::string formatted = motion::formatSkills(text, kFile, kOthers);
  if (motion::formatSkills(formatted, kFile, kOthers) != formatted) return "formatting twice differs";
  if (describe(motion::parseSkills(formatted, kFile, nullptr, kOthers)) != describe(skills))
    return "formatted it means something else";
  return checkPlaying(skills);
}

}  // namespace nonet::fuzz
