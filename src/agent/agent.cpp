#include "nonet/agent/agent.h"

#include "nonet/agent/skill_show.h"
#include "nonet/team/behavior.h"

namespace nonet::agent {

struct Agent::Stages {
  explicit Stages(const AgentSettings& agentSettings)
      : settings(agentSettings),
        robot(robotSettings(settings)),
        behavior(settings.parameters.team, settings.challenge) {
    if (settings.skill) show.emplace(*settings.skill);
  }

  AgentSettings settings;
  Robot robot;
  team::Behavior behavior;
  std::optional<SkillShow> show;
  protocol::Effectors effectors;
  bool asked = false;
};

RobotSettings robotSettings(const AgentSettings& settings) {
  RobotSettings robot;
  robot.robotType = settings.robotType;
  robot.team = settings.team;
  robot.seed = settings.seed;
  robot.world = settings.parameters.world;
  robot.motion = settings.parameters.motion;
  robot.skillFolder = settings.skillFolder;
  return robot;
}

Agent::Agent(const AgentSettings& settings) : stages_(std::make_unique<Stages>(settings)) {}
Agent::~Agent() = default;

protocol::Effectors Agent::hello() const {
  protocol::Effectors effectors;
  effectors.scene.emplace();
  effectors.scene->robotType = stages_->settings.robotType;
  return effectors;
}

const protocol::Effectors& Agent::step(const protocol::Percept& percept) {
  Stages& s = *stages_;
  protocol::Effectors& effectors = s.effectors;
  const double before = s.robot.world().time;
  const world::WorldState& world = s.robot.sense(percept);
  if (s.asked && world.time == before) {
    // A message once more: nothing has moved since, so the joints go on, and what was said is said.
    effectors.keepSpeeds();
    return effectors;
  }
  effectors.clear();
  if (!s.asked) {
    effectors.init.emplace();
    effectors.init->unum = s.settings.unum;
    effectors.init->team.assign(s.settings.team);
    s.asked = true;
  }

  team::Action action = s.behavior.update(world, s.robot.motion().state());
  if (action.beam && s.settings.startPose) action.beam = s.settings.startPose;
  if (s.show) {
    action.motion = s.show->update(world, s.robot.motion().state());
    if (s.robot.motion().state().busy) action.beam.reset();
  }
  s.robot.act(action, effectors);
  return effectors;
}

const world::WorldState& Agent::world() const {
  return stages_->robot.world();
}
std::vector<Pose2> Agent::particles() const {
  return stages_->robot.particles();
}
team::Role Agent::role() const {
  return stages_->behavior.role();
}
const std::optional<protocol::RoleVote>& Agent::agreedRoles() const {
  return stages_->behavior.agreed();
}
std::string_view Agent::kick() const {
  const motion::MotionState& motion = stages_->robot.motion().state();
  return motion.busy ? motion.kick.name : std::string_view();
}
const team::Action& Agent::action() const {
  return stages_->behavior.action();
}
void Agent::recordCandidates(bool on) {
  stages_->behavior.recordCandidates(on);
}
const AgentSettings& Agent::settings() const {
  return stages_->settings;
}

}  // namespace nonet::agent
