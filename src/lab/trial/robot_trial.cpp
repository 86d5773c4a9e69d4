#include "nonet/lab/trial/robot_trial.h"

#include <algorithm>
#include <cmath>

#include "nonet/lab/trial/true_pose.h"
#include "nonet/math/random.h"
#include "nonet/model/ball.h"
#include "nonet/protocol/rounding.h"
#include "nonet/sim/sensors/sensors.h"

namespace nonet::lab {

namespace {

using model::BodyId;

constexpr double kStartHeight = 0.4;   // m, as after a beam (server facts 4.6)
constexpr double kOpenGround = 300.0;  // m, length and width of a field so large that nobody leaves it
constexpr double kBallAside = 0.45;    // of the field's width: where the ball is in nobody's way

}  // namespace

TrialSettings trialSettings(const agent::AgentSettings& settings) {
  return {agent::robotSettings(settings), {}};
}

TrialSettings onOpenGround(TrialSettings setup) {
  setup.physics.fieldLength = setup.physics.fieldWidth = kOpenGround;
  return setup;
}

struct RobotTrial::Implementation {
  explicit Implementation(const TrialSettings& setup)
      : physics(setup.physics), handle(physics.addRobot(setup.robotType)), robot(setup) {
    blind.vision = false;
    const double aside = kBallAside * setup.physics.fieldWidth;
    physics.setBallPosition(Vector3(0.0, -aside, model::kBallRadius).cast<float>());
  }

  void sense() {
    percept.clear();
    percept.time = protocol::roundToWire(serverTime);
    percept.game.playMode = protocol::PlayMode::PlayOn;
    sensors.fill(physics, handle, blind, noise, percept);
    robot.sense(percept);
    effectors.clear();
  }

  // The physics step that follows a message still runs with the commands in answer to the one before it.
  void advance() {
    protocol::roundAsWritten(effectors);
    for (const model::JointSpec& joint : robot.model().joints()) {
      if (!underWay.hasSpeed(joint.id)) continue;
      physics.setJointSpeed(handle, joint.id, static_cast<float>(underWay.speeds[model::index(joint.id)]));
    }
    underWay = effectors;
    physics.prePhysics();
    physics.stepPhysics();
    serverTime += static_cast<float>(kCycleTime);  // drifts as the server's clock does
  }

  sim::World physics;
  sim::RobotHandle handle;
  agent::Robot robot;
  // Without vision the sensors use neither calibration nor noise.
  sim::AgentSensors sensors{sim::Vector3f(sim::Vector3f::Zero())};
  sim::SensorContext blind;
  Random noise{0};
  float serverTime = 0.0F;  // s
  protocol::Percept percept;
  protocol::Effectors effectors;
  protocol::Effectors underWay;
};

RobotTrial::RobotTrial(const TrialSettings& setup)
    : implementation_(std::make_unique<Implementation>(setup)) {}
RobotTrial::~RobotTrial() = default;

void RobotTrial::place(const Pose2& X_FR) {
  Implementation& t = *implementation_;
  const double lift = std::max(kStartHeight, t.robot.model().standingHeight() + 0.015);
  const sim::Vector3f position(static_cast<float>(X_FR.translation.x()),
                               static_cast<float>(X_FR.translation.y()), static_cast<float>(lift));
  t.physics.placeRobot(t.handle, position, static_cast<float>(toDegrees(X_FR.rotation) - 90.0));
}

void RobotTrial::settle(const Pose2& X_FR) {
  Implementation& t = *implementation_;
  place(X_FR);
  run(motion::MotionRequest{}, 1.2);
  const sim::Vector3f now = t.physics.bodyPosition(t.handle, BodyId::Torso);
  t.physics.moveRobot(t.handle, sim::Vector3f(static_cast<float>(X_FR.translation.x()),
                                              static_cast<float>(X_FR.translation.y()), now.z()));
  run(motion::MotionRequest{}, kCycleTime);  // the scene shows the move after the next step
}

void RobotTrial::step(const motion::MotionRequest& request, const motion::HeadRequest& head) {
  Implementation& t = *implementation_;
  t.sense();
  team::Action action;
  action.motion = request;
  action.head = head;
  t.robot.act(action, t.effectors);
  t.advance();
}

void RobotTrial::run(const motion::MotionRequest& request, double seconds) {
  const int cycles = static_cast<int>(std::lround(seconds / kCycleTime));
  for (int i = 0; i < cycles; ++i) step(request);
}

void RobotTrial::stepJoints(const motion::JointTargets& targets) {
  Implementation& t = *implementation_;
  t.sense();
  t.robot.follow(targets, t.effectors);
  t.advance();
}

void RobotTrial::stepSpeeds(const model::JointArray& speeds) {
  Implementation& t = *implementation_;
  t.sense();
  for (const model::JointSpec& joint : t.robot.model().joints()) {
    t.effectors.setSpeed(joint.id, speeds[model::index(joint.id)]);
  }
  t.advance();
}

Pose2 RobotTrial::pose() const {
  return truePose(implementation_->physics, implementation_->handle);
}
Vector3 RobotTrial::torsoPosition() const {
  return implementation_->physics.bodyPose(implementation_->handle, BodyId::Torso).position.cast<double>();
}
double RobotTrial::tilt() const {
  return trueTilt(implementation_->physics, implementation_->handle);
}
bool RobotTrial::down() const {
  return isDown(implementation_->physics, implementation_->handle);
}

double RobotTrial::time() const {
  return implementation_->physics.time();
}
sim::World& RobotTrial::physics() {
  return implementation_->physics;
}
sim::RobotHandle RobotTrial::robot() const {
  return implementation_->handle;
}
const world::WorldState& RobotTrial::belief() const {
  return implementation_->robot.world();
}
const motion::Motion& RobotTrial::motion() const {
  return implementation_->robot.motion();
}
const protocol::Percept& RobotTrial::percept() const {
  return implementation_->percept;
}
const model::RobotModel& RobotTrial::model() const {
  return implementation_->robot.model();
}
void RobotTrial::restorePhysics(std::span<const std::uint8_t> state) {
  implementation_->physics.restore(state);
}

}  // namespace nonet::lab
