#include "nonet/agent/robot.h"

#include "nonet/motion/joint_control.h"
#include "nonet/world/world_model.h"

namespace nonet::agent {

struct Robot::Stages {
  explicit Stages(const RobotSettings& settings)
      : model(model::robotModel(settings.robotType)),
        worldModel(model, settings.world, protocol::TeamName(settings.team), settings.seed),
        motion(model, settings.motion, settings.skillFolder),
        control(model, settings.motion.control) {}

  const model::RobotModel& model;
  world::WorldModel worldModel;
  motion::Motion motion;
  motion::JointControl control;
};

Robot::Robot(const RobotSettings& settings) : stages_(std::make_unique<Stages>(settings)) {}
Robot::~Robot() = default;

const world::WorldState& Robot::sense(const protocol::Percept& percept) {
  return stages_->worldModel.update(percept, stages_->motion.state().beam);
}

void Robot::act(const team::Action& action, protocol::Effectors& effectors) {
  if (action.beam) effectors.beam = action.beam;
  effectors.say = action.say;
  effectors.pass = action.passMode;
  const motion::HeadRequest head = action.head.value_or(motion::HeadRequest{});
  follow(stages_->motion.update(world(), action.motion, head, action.beam), effectors);
}

void Robot::follow(const motion::JointTargets& targets, protocol::Effectors& effectors) {
  stages_->control.update(world().body, targets, effectors);
}

const world::WorldState& Robot::world() const {
  return stages_->worldModel.state();
}
std::vector<Pose2> Robot::particles() const {
  return stages_->worldModel.particles();
}
const motion::Motion& Robot::motion() const {
  return stages_->motion;
}
const model::RobotModel& Robot::model() const {
  return stages_->model;
}

}  // namespace nonet::agent
