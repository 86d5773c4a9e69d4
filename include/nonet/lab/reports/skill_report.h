// What is told of a skill that was tried out (lab/trial/skill_trial.h): a few lines, JSON, a picture of its
// joints.
#pragma once

#include <string>

#include "nonet/lab/trial/skill_trial.h"

namespace nonet::lab {

std::string skillReportText(const SkillTrial& trial, const SkillTrialSettings& settings);

/// Angles in degrees as the language counts them. With a ball the object "kick".
std::string skillReportJson(const SkillTrial& trial, const SkillTrialSettings& settings);

/// A panel for each joint that moves (class "joint"), one for the torso, and one for the ball if there was
/// one: what it was told, what it did, its limits, and where the statements of the skill begin.
std::string skillReportSvg(const SkillTrial& trial, const SkillTrialSettings& settings);

}  // namespace nonet::lab
