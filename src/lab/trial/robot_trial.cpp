#include "nonet/lab/trial/robot_trial.h"

#include <algorithm>
#include <cmath>

#include "nonet/protocol/effectors.h"
#include "nonet/protocol/rounding.h"

namespace nonet::lab {

namespace {

using model::BodyId;

constexpr double kStartHeight = 0.4;  // m, as after a beam (server facts 4.6)

// Server axes (x right, y forward) to robot axes (x forward, y left).
Vector3 toRobot(double x, double y, double z) {
  return {y, -x, z};
}

std::optional<protocol::FootForce> forceOf(const sim::World& world, sim::RobotHandle robot, BodyId foot) {
  const auto contact = world.footContact(robot, foot);
  if (!contact) return std::nullopt;
  const auto rounded = [](const sim::Vector3f& v) {
    return toRobot(protocol::roundToWire(v.x()), protocol::roundToWire(v.y()), protocol::roundToWire(v.z()));
  };
  return protocol::FootForce{rounded(contact->center), rounded(contact->force)};
}

}  // namespace

TrialSetup trialSetup(const agent::AgentConfig& config) {
  TrialSetup setup;
  setup.robotType = config.robotType;
  setup.motion = config.parameters.motion;
  setup.world = config.parameters.world;
  setup.skillFolder = config.skillFolder;
  return setup;
}

struct RobotTrial::Implementation {
  explicit Implementation(const TrialSetup& trialSetup)
      : setup(trialSetup),
        model(model::robotModel(setup.robotType)),
        physics(setup.physics),
        robot(physics.addRobot(setup.robotType)),
        worldModel(model, setup.world, protocol::TeamName("Trial"), setup.seed),
        motion(model, setup.motion, setup.skillFolder),
        control(model, setup.motion.control),
        random(setup.seed) {
    physics.setBallPosition({0.0F, -9.0F, 0.042F});
  }

  void sense() {
    percept.clear();
    percept.time = protocol::roundToWire(static_cast<float>(physics.time()));
    percept.game.playMode = protocol::PlayMode::PlayOn;
    const auto degrees = [](float radians) {
      return protocol::degreesFromWire(protocol::roundToWire(radians * static_cast<float>(180.0 / kPi)));
    };
    const sim::Vector3f gyro = physics.gyro(robot);
    percept.gyro = toRobot(degrees(gyro.x()), degrees(gyro.y()), degrees(gyro.z()));
    const sim::Vector3f a = physics.accelerometer(robot);
    percept.accelerometer =
        toRobot(protocol::roundToWire(a.x()), protocol::roundToWire(a.y()), protocol::roundToWire(a.z()));
    for (const model::JointSpec& joint : model.joints()) {
      const double angle =
          protocol::degreesFromWire(protocol::roundToWire(physics.jointAngleDegrees(robot, joint.id)));
      percept.joints[model::index(joint.id)] = angle;
      percept.jointsPresent |= 1U << model::index(joint.id);
    }
    using protocol::ForceSensor;
    const auto put = [&](ForceSensor sensor, BodyId body) {
      if (model.has(body)) percept.forces[static_cast<std::size_t>(sensor)] = forceOf(physics, robot, body);
    };
    put(ForceSensor::RFoot, BodyId::RFoot);
    put(ForceSensor::LFoot, BodyId::LFoot);
    put(ForceSensor::RToe, BodyId::RToe);
    put(ForceSensor::LToe, BodyId::LToe);
    belief = &worldModel.update(percept);
  }

  // The physics step that follows a message still runs with the commands in answer to the one before it.
  void advance() {
    protocol::roundAsWritten(effectors);
    for (const model::JointSpec& joint : model.joints()) {
      if (!underWay.hasSpeed(joint.id)) continue;
      physics.setJointSpeed(robot, joint.id, static_cast<float>(underWay.speeds[model::index(joint.id)]));
    }
    underWay = effectors;
    physics.prePhysics();
    physics.stepPhysics();
  }

  TrialSetup setup;
  const model::RobotModel& model;
  sim::World physics;
  sim::RobotHandle robot;
  world::WorldModel worldModel;
  motion::Motion motion;
  motion::JointControl control;
  Random random;
  protocol::Percept percept;
  protocol::Effectors effectors;
  protocol::Effectors underWay;
  const world::WorldState* belief = nullptr;
  world::WorldState nothing;
};

RobotTrial::RobotTrial(const TrialSetup& setup) : implementation_(std::make_unique<Implementation>(setup)) {
  implementation_->belief = &implementation_->nothing;
}
RobotTrial::~RobotTrial() = default;

void RobotTrial::place(const Pose2& X_FR) {
  Implementation& t = *implementation_;
  const double lift = std::max(kStartHeight, t.model.standingHeight() + 0.015);
  const sim::Vector3f position(static_cast<float>(X_FR.translation.x()),
                               static_cast<float>(X_FR.translation.y()), static_cast<float>(lift));
  t.physics.placeRobot(t.robot, position, static_cast<float>(toDegrees(X_FR.rotation) - 90.0));
  t.worldModel.expectBeam(X_FR);
}

void RobotTrial::settle(const Pose2& X_FR) {
  Implementation& t = *implementation_;
  place(X_FR);
  run(motion::MotionRequest{}, 1.2);
  const sim::Vector3f now = t.physics.bodyPosition(t.robot, BodyId::Torso);
  t.physics.moveRobot(t.robot, sim::Vector3f(static_cast<float>(X_FR.translation.x()),
                                             static_cast<float>(X_FR.translation.y()), now.z()));
  run(motion::MotionRequest{}, kCycleTime);  // the scene shows the move after the next step
}

void RobotTrial::step(const motion::MotionRequest& request, const motion::HeadRequest& head) {
  Implementation& t = *implementation_;
  t.sense();
  const motion::JointTargets& targets = t.motion.update(*t.belief, request, head);
  t.effectors.clear();
  t.control.update(t.belief->body, targets, t.effectors);
  t.advance();
}

void RobotTrial::run(const motion::MotionRequest& request, double seconds) {
  const int cycles = static_cast<int>(std::lround(seconds / kCycleTime));
  for (int i = 0; i < cycles; ++i) step(request);
}

void RobotTrial::stepJoints(const motion::JointTargets& targets) {
  Implementation& t = *implementation_;
  t.sense();
  t.effectors.clear();
  t.control.update(t.belief->body, targets, t.effectors);
  t.advance();
}

void RobotTrial::stepSpeeds(const model::JointArray& speeds) {
  Implementation& t = *implementation_;
  t.sense();
  t.effectors.clear();
  for (const model::JointSpec& joint : t.model.joints()) {
    t.effectors.setSpeed(joint.id, speeds[model::index(joint.id)]);
  }
  t.advance();
}

Pose2 RobotTrial::pose() const {
  const Implementation& t = *implementation_;
  const sim::ScenePose& torso = t.physics.bodyPose(t.robot, BodyId::Torso);
  const sim::Vector3f forward = torso.rotation.col(1);
  return {torso.position.x(), torso.position.y(), std::atan2(forward.y(), forward.x())};
}

Vector3 RobotTrial::torsoPosition() const {
  const Implementation& t = *implementation_;
  return t.physics.bodyPose(t.robot, BodyId::Torso).position.cast<double>();
}

double RobotTrial::tilt() const {
  const Implementation& t = *implementation_;
  const double up = t.physics.bodyPose(t.robot, BodyId::Torso).rotation(2, 2);
  return std::acos(std::clamp(up, -1.0, 1.0));
}

bool RobotTrial::down() const {
  return torsoPosition().z() < 0.55 * implementation_->model.standingHeight();
}

double RobotTrial::time() const {
  return implementation_->physics.time();
}
sim::World& RobotTrial::physics() {
  return implementation_->physics;
}
sim::RobotHandle RobotTrial::robot() const {
  return implementation_->robot;
}
const world::WorldState& RobotTrial::belief() const {
  return *implementation_->belief;
}
motion::Motion& RobotTrial::motion() {
  return implementation_->motion;
}
const model::RobotModel& RobotTrial::model() const {
  return implementation_->model;
}
Random& RobotTrial::random() {
  return implementation_->random;
}

std::vector<std::uint8_t> RobotTrial::savePhysics() const {
  return implementation_->physics.save();
}
void RobotTrial::restorePhysics(std::span<const std::uint8_t> state) {
  implementation_->physics.restore(state);
}

}  // namespace nonet::lab
