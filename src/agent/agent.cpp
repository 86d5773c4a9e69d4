#include "nonet/agent/agent.h"

#include "nonet/agent/skill_show.h"
#include "nonet/team/behavior.h"

namespace nonet::agent {

struct Agent::Stages {
  explicit Stages(const AgentConfig& agentConfig)
      : config(agentConfig), robot(robotConfig(config)), behavior(config.parameters.team, config.challenge) {
    if (config.skill) show.emplace(*config.skill);
  }

  AgentConfig config;
  Robot robot;
  team::Behavior behavior;
  std::optional<SkillShow> show;
  protocol::Effectors effectors;
  bool asked = false;
};

RobotConfig robotConfig(const AgentConfig& config) {
  RobotConfig robot;
  robot.robotType = config.robotType;
  robot.team = config.team;
  robot.seed = config.seed;
  robot.world = config.parameters.world;
  robot.motion = config.parameters.motion;
  robot.skillFolder = config.skillFolder;
  return robot;
}

Agent::Agent(const AgentConfig& config) : stages_(std::make_unique<Stages>(config)) {}
Agent::~Agent() = default;

protocol::Effectors Agent::hello() const {
  protocol::Effectors effectors;
  effectors.scene.emplace();
  effectors.scene->robotType = stages_->config.robotType;
  return effectors;
}

const protocol::Effectors& Agent::step(const protocol::Percept& percept) {
  Stages& s = *stages_;
  protocol::Effectors& effectors = s.effectors;
  effectors.clear();
  if (!s.asked) {
    effectors.init.emplace();
    effectors.init->unum = s.config.unum;
    effectors.init->team.assign(s.config.team);
    s.asked = true;
  }

  const world::WorldState& world = s.robot.sense(percept);
  team::Action action = s.behavior.update(world, s.robot.motion().state());
  if (action.beam && s.config.startPose) action.beam = s.config.startPose;
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
const AgentConfig& Agent::config() const {
  return stages_->config;
}

}  // namespace nonet::agent
