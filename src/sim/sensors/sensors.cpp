#include "nonet/sim/sensors/sensors.h"

#include <cmath>

#include "nonet/protocol/rounding.h"
#include "nonet/protocol/server_axes.h"

#include "sim/physics/scene.h"
#include "sim/sensors/on_wire.h"

namespace nonet::sim {

namespace {

using protocol::PerceptKind;
using protocol::SeenKind;

/// A position in the own team's frame: turned by 180 degrees for the right team.
Vector3f turned(const Vector3f& v, protocol::TeamSide side) {
  return side == protocol::TeamSide::Right ? Vector3f(-v.x(), -v.y(), v.z()) : v;
}

// The order of the fixed objects in the server's messages; the ball comes last.
constexpr std::array kLandmarkOrder{protocol::Landmark::G1L, protocol::Landmark::G2L, protocol::Landmark::G2R,
                                    protocol::Landmark::G1R, protocol::Landmark::F1L, protocol::Landmark::F2L,
                                    protocol::Landmark::F1R, protocol::Landmark::F2R};

// Indexed by protocol::BodyPart, in the order of the messages.
constexpr std::array kVisibleParts{model::BodyId::Head, model::BodyId::RLowerArm, model::BodyId::LLowerArm,
                                   model::BodyId::RFoot, model::BodyId::LFoot};

void seeFixedObjects(const VisionField& field, const Vector3f& ball, Camera& camera,
                     protocol::Vision& vision) {
  for (const protocol::Landmark id : kLandmarkOrder) {
    if (const auto seen = camera.look(field.landmarks[static_cast<std::size_t>(id)])) {
      vision.landmarks.push_back({id, seen->onWire()});
      vision.order.push_back(SeenKind::Landmark);
    }
  }
  if (const auto seen = camera.look(ball)) {
    vision.ball = seen->onWire();
    vision.order.push_back(SeenKind::Ball);
  }
}

void seePlayer(const World& world, const VisiblePlayer& player, Camera& camera, protocol::Vision& vision) {
  protocol::SeenPlayer seen;
  bool any = false;
  for (std::size_t i = 0; i < kVisibleParts.size(); ++i) {
    const Vector3f& position = world.bodyPose(player.robot, kVisibleParts[i]).position;
    if (const auto part = camera.look(position)) {
      seen.parts[i] = part->onWire();
      any = true;
    }
  }
  if (!any) return;
  seen.team = player.team;
  seen.unum = player.unum;
  vision.players.push_back(seen);
  vision.order.push_back(SeenKind::Player);
}

void addTruth(const World& world, const ScenePose& head, const SensorContext& context,
              protocol::Vision& vision) {
  if (context.truePosition) {
    vision.truePosition = onWire(turned(head.position, context.side));
    vision.order.push_back(SeenKind::MyPosition);
  }
  if (context.trueHeading) {
    const Vector3f forward = turned(head.rotation.col(1), context.side);
    vision.trueHeading = protocol::radiansOnWire(scene::toDegrees(std::atan2(forward.y(), forward.x())));
    vision.order.push_back(SeenKind::MyOrientation);
  }
  if (context.trueBallPosition) {
    vision.trueBallPosition = onWire(turned(world.ballPose().position, context.side));
    vision.order.push_back(SeenKind::BallPosition);
  }
}

void seeLines(const VisionField& field, Camera& camera, protocol::Vision& vision) {
  for (const VisionField::Line& line : field.lines) {
    if (const auto seen = camera.look(line)) {
      vision.lines.push_back({seen->begin.onWire(), seen->end.onWire()});
      vision.order.push_back(SeenKind::Line);
    }
  }
}

model::BodyId footOf(protocol::ForceSensor sensor) {
  switch (sensor) {
    case protocol::ForceSensor::RFoot:
      return model::BodyId::RFoot;
    case protocol::ForceSensor::LFoot:
      return model::BodyId::LFoot;
    case protocol::ForceSensor::RToe:
      return model::BodyId::RToe;
    case protocol::ForceSensor::LToe:
      break;
  }
  return model::BodyId::LToe;
}

}  // namespace

void AgentSensors::addJoint(const World& world, RobotHandle self, model::JointId joint,
                            protocol::Percept& percept) const {
  percept.joints[index(joint)] = protocol::radiansOnWire(world.jointAngleDegrees(self, joint));
  percept.jointsPresent |= 1U << index(joint);
  percept.order.push_back({PerceptKind::Joint, static_cast<std::uint8_t>(joint)});
}

void AgentSensors::addForce(const World& world, RobotHandle self, protocol::ForceSensor sensor,
                            protocol::Percept& percept) const {
  const auto contact = world.footContact(self, footOf(sensor));
  if (!contact) return;
  percept.forces[static_cast<std::size_t>(sensor)] =
      protocol::FootForce{protocol::robotFromServerAxes(onWire(contact->center)),
                          protocol::robotFromServerAxes(onWire(contact->force))};
  percept.order.push_back({PerceptKind::Force, static_cast<std::uint8_t>(sensor)});
}

// Joints 1..5, foot force, joint 6, and on type 4 toe force and joint 7 (server facts 1.5).
void AgentSensors::addLeg(const World& world, RobotHandle self, bool left, protocol::Percept& percept) const {
  using protocol::ForceSensor;
  const std::size_t first = index(left ? model::JointId::LLeg1 : model::JointId::RLeg1);
  for (std::size_t i = 0; i < 5; ++i) addJoint(world, self, model::jointAt(first + i), percept);
  addForce(world, self, left ? ForceSensor::LFoot : ForceSensor::RFoot, percept);
  addJoint(world, self, model::jointAt(first + 5), percept);
  if (!model::robotModel(world.robotType(self)).hasToes()) return;
  addForce(world, self, left ? ForceSensor::LToe : ForceSensor::RToe, percept);
  addJoint(world, self, model::jointAt(first + 6), percept);
}

void AgentSensors::fill(const World& world, RobotHandle self, const SensorContext& context, Random& random,
                        protocol::Percept& percept) {
  const Vector3f rate = world.gyro(self);
  percept.gyro = protocol::robotFromServerAxes({protocol::radiansOnWire(scene::toDegrees(rate.x())),
                                                protocol::radiansOnWire(scene::toDegrees(rate.y())),
                                                protocol::radiansOnWire(scene::toDegrees(rate.z()))});
  percept.order.push_back({PerceptKind::Gyro, 0});
  percept.accelerometer = protocol::robotFromServerAxes(onWire(world.accelerometer(self)));
  percept.order.push_back({PerceptKind::Accelerometer, 0});
  addJoint(world, self, model::JointId::Head1, percept);
  addJoint(world, self, model::JointId::Head2, percept);
  if (context.vision && context.field != nullptr) {
    const ScenePose& head = world.bodyPose(self, model::BodyId::Head);
    const Vector3f calibration = context.noise ? calibration_ : Vector3f::Zero();
    Camera camera(head, calibration, context.noise ? &random : nullptr);
    protocol::Vision& vision = percept.beginVision();
    seeFixedObjects(*context.field, world.ballPose().position, camera, vision);
    for (const VisiblePlayer& player : context.players) seePlayer(world, player, camera, vision);
    addTruth(world, head, context, vision);
    seeLines(*context.field, camera, vision);
    percept.order.push_back({PerceptKind::See, 0});
  }
  for (const model::JointId first : {model::JointId::RArm1, model::JointId::LArm1}) {
    for (std::size_t i = 0; i < 4; ++i) addJoint(world, self, model::jointAt(index(first) + i), percept);
  }
  addLeg(world, self, false, percept);
  addLeg(world, self, true, percept);
}

}  // namespace nonet::sim
