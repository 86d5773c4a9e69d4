#include "nonet/agent/agent.h"

#include "nonet/motion/joint_control.h"
#include "nonet/motion/motion.h"
#include "nonet/team/behavior.h"
#include "nonet/world/world_model.h"

namespace nonet::agent {

struct Agent::Stages {
  explicit Stages(const AgentConfig& agentConfig)
      : config(agentConfig),
        model(model::robotModel(agentConfig.robotType)),
        worldModel(model, config.parameters.world, protocol::TeamName(config.team), config.seed),
        behavior(config.parameters.team),
        motion(model, config.parameters.motion, config.skillFolder),
        control(model, config.parameters.motion.control) {}

  AgentConfig config;
  const model::RobotModel& model;
  world::WorldModel worldModel;
  team::Behavior behavior;
  motion::Motion motion;
  motion::JointControl control;
  const world::WorldState* world = nullptr;
  world::WorldState unknown;  // before the first message
  protocol::Effectors effectors;
  team::Intent intent;
  bool asked = false;
};

Agent::Agent(const AgentConfig& config) : stages_(std::make_unique<Stages>(config)) {
  stages_->world = &stages_->unknown;
}
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

  s.world = &s.worldModel.update(percept);
  s.intent = s.behavior.update(*s.world, s.motion.state());
  const team::Intent& intent = s.intent;
  if (intent.beam) {
    if (s.config.startPose) s.intent.beam = s.config.startPose;
    effectors.beam = intent.beam;
    s.worldModel.expectBeam(*intent.beam);
    s.motion.expectPutDown();
  }
  effectors.say = intent.say;
  effectors.pass = intent.pass;
  const motion::JointTargets& targets = s.motion.update(*s.world, intent.motion, intent.head);
  s.control.update(s.world->body, targets, effectors);
  return effectors;
}

const world::WorldState& Agent::world() const {
  return *stages_->world;
}
team::Role Agent::role() const {
  return stages_->behavior.role();
}
const team::Intent& Agent::intent() const {
  return stages_->intent;
}
const AgentConfig& Agent::config() const {
  return stages_->config;
}

}  // namespace nonet::agent
