// One skill played once by a robot that stands, to try out a new skill or kick: what every joint was told and
// did, where the torso and the ball went. On the complete simulation with the exact stepper, alone on the
// field; the skill's program and joint control are those of play. Other than in play nobody takes over at the
// end: the last posture is held, so that one sees whether the robot stays on its feet in it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "nonet/agent/agent.h"
#include "nonet/model/joints.h"
#include "nonet/motion/skill_player.h"

namespace nonet::lab {

struct SkillTrialSettings {
  agent::AgentSettings agent;  // its type, parameters and skill folder
  std::string skill;
  bool mirrored = false;        // left and right exchanged
  std::optional<Vector2> ball;  // from the torso, m; empty: where a kick wants it, or far away
  double seconds = 0.0;         // watched from the skill's begin; 0: until all is quiet after its end
  std::string monitorLog;       // a message for each cycle; empty: none
};

struct SkillCycle {
  double time = 0.0;           // s since the skill began
  model::JointArray target{};  // rad, what the joints were told until then: acts two cycles later
  model::JointArray angle{};   // rad, true at this time
  double torsoHeight = 0.0;    // m
  double tilt = 0.0;           // rad between torso and upright
  double ballSpeed = 0.0;      // m/s
};

/// From when on a statement of the skill, or of one that it calls, was carried out.
struct SkillMark {
  double time = 0.0;  // s
  std::string skill;
  int line = 0;  // of its file
};

/// What became of the ball that was put before the robot; seen from its place and heading at the begin.
struct SkillKick {
  Vector2 p_RPlace = Vector2::Zero();  // where it lay, m
  bool fromWalk = false;               // the kick's head says that it begins out of steps, not from a stand
  bool contact = false;
  double time = 0.0;       // s, of the contact
  double speed = 0.0;      // m/s, the fastest
  double height = 0.0;     // m, of the centre, the highest
  double distance = 0.0;   // m, until it has rolled out
  double direction = 0.0;  // rad, positive to the left
  double intended = 0.0;   // rad, the direction in the kick's head; 0 for other skills
};

struct SkillTrial {
  enum class Result { Finished, Failed, Running };  // Failed: the skill said so

  Result result = Result::Running;
  double duration = 0.0;  // s until the skill was over, or watched
  bool fell = false;      // the torso was below 0.55 of the standing height: it lay or knelt
  std::vector<SkillCycle> cycles;
  std::vector<SkillMark> marks;
  std::vector<motion::SkillPlayer::Stretch> stretches;  // of curves that take longer than they should
  std::optional<SkillKick> kick;                        // if there was a ball
  std::string recordingError;  // why the monitor log is not whole, with its name; empty if it is

  /// Joints whose target changes, in the order of JointId.
  std::vector<model::JointId> moved() const;
};

/// The same settings always give the same trial. Throws std::runtime_error: there is no such skill, or the
/// monitor log cannot be created.
SkillTrial playSkill(const SkillTrialSettings& settings);

}  // namespace nonet::lab
