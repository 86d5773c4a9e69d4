#include "sim/physics/mechanism.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "nonet/math/angle.h"

#include "sim/physics/ode_parameters.h"
#include "sim/physics/scene.h"
#include "sim/physics/workers.h"

namespace nonet::sim {

namespace {

using model::BodyId;
using scene::scriptNumber;
using scene::scriptVector;

const Vector3f kBirthPlace{0.0F, -1.0F, 1.5F};  // of a robot's torso

// Speed limit of the joints that are given in degrees per second, after the script's arithmetic.
double defaultJointSpeed() {
  return scriptNumber(3.14159265 * scriptNumber(351.77 / 180.0));
}

/// From the model's robot frame (x forward, y left) to the server's body frame (x right, y forward).
Vector3 toServer(const Vector3& v) {
  return {0.0 - v.y(), v.x(), v.z()};
}

// A robot part as the scene description computes it.
struct Part {
  Vector3 offset = Vector3::Zero();   // to the parent's centre, server axes
  Vector3 extents = Vector3::Zero();  // box
  Vector3 anchor = Vector3::Zero();   // of its joint, own frame
  double mass = 0.0;
};

// The description of type 4 computes foot and toe from the toe's length; each step is rounded to six digits.
void adjustFootWithToe(const model::RobotModel& model, BodyId id, Part& part) {
  constexpr double kFootLength = 0.16;
  constexpr double kFootMass = 0.2;
  const double toeLength = scriptNumber(model.body(BodyId::RToe).shape.size.x());
  const double share = scriptNumber(scriptNumber(toeLength / kFootLength) * 0.5);
  if (id == BodyId::RFoot || id == BodyId::LFoot) {
    const double footLength = scriptNumber(kFootLength - toeLength);
    part.extents.y() = footLength;
    part.mass = scriptNumber(scriptNumber(1.0 - share) * kFootMass);
    part.offset.y() = scriptNumber(scriptNumber(footLength * 0.5) - 0.05);
  } else if (id == BodyId::RToe || id == BodyId::LToe) {
    part.extents.y() = toeLength;
    part.mass = scriptNumber(share * kFootMass);
    part.anchor.y() = scriptNumber(-0.5 * toeLength);
  }
}

Part partFor(const model::RobotModel& model, const model::BodySpec& spec) {
  Part part;
  part.offset = toServer(spec.offset);
  part.extents = scene::extentsInServerAxes(spec.shape.size);
  part.mass = spec.mass;
  if (spec.joint) part.anchor = toServer(model.joint(*spec.joint).anchor);
  if (model.hasToes()) adjustFootWithToe(model, spec.id, part);
  return part;
}

Vector3f sizeOf(const model::Shape& shape, const Part& part) {
  return shape.kind == model::ShapeKind::Box ? Vector3f(part.extents.cast<float>())
                                             : Vector3f(shape.size.cast<float>());
}

RobotPlan::Joint planJoint(const model::JointSpec& spec, const Part& part, const ScenePose& child,
                           std::size_t parent) {
  RobotPlan::Joint joint;
  joint.id = spec.id;
  joint.parent = parent;
  const bool byDegrees = std::abs(spec.maxSpeed - toRadians(351.77)) < 1e-9;
  joint.maxSpeed = static_cast<float>(byDegrees ? defaultJointSpeed() : scriptNumber(spec.maxSpeed));
  joint.lowStop = scene::toRadians(static_cast<float>(std::round(toDegrees(spec.low))));
  joint.highStop = scene::toRadians(static_cast<float>(std::round(toDegrees(spec.high))));
  joint.anchor = scene::transform(child, scriptVector(part.anchor));
  // The hip's axis is written as 0.7071, ODE normalises it.
  const Vector3 scaled = toServer(spec.axis).unaryExpr(
      [](double c) { return std::abs(std::abs(c) - 0.7071) < 1e-4 ? std::copysign(0.7071, c) : c; });
  joint.axis = scene::rotate(child.rotation, scriptVector(scaled));
  return joint;
}

RobotPlan makePlan(int type) {
  const model::RobotModel& model = model::robotModel(type);
  RobotPlan plan;
  std::array<Vector3, model::kBodyCount> places;  // as the description computes them, server axes
  std::array<std::size_t, model::kBodyCount> indices{};
  for (const model::BodySpec& spec : model.bodies()) {
    const Part part = partFor(model, spec);
    Vector3& place = places[index(spec.id)];
    if (spec.joint) {
      const Vector3& parent = places[index(spec.parent)];
      for (int i = 0; i < 3; ++i) place[i] = scriptNumber(parent[i] + scriptNumber(part.offset[i]));
    } else {
      place = kBirthPlace.cast<double>();
    }
    indices[index(spec.id)] = plan.bodies.size();
    RobotPlan::Body body;
    body.id = spec.id;
    body.shape = spec.shape.kind;
    body.size = sizeOf(spec.shape, part);
    body.mass = static_cast<float>(part.mass);
    body.collider = spec.collider;
    body.pose.position = place.cast<float>();
    if (spec.joint) {
      body.joint = planJoint(model.joint(*spec.joint), part, body.pose, indices[index(spec.parent)]);
    }
    plan.bodies.push_back(body);
  }
  return plan;
}

void placeBody(dBodyID body, const ScenePose& pose) {
  dMatrix3 rotation;
  scene::toOde(pose.rotation, rotation);
  dBodySetRotation(body, rotation);
  dBodySetPosition(body, pose.position.x(), pose.position.y(), pose.position.z());
}

void setMass(dBodyID body, const RobotPlan::Body& plan) {
  dMass mass;
  switch (plan.shape) {
    case model::ShapeKind::Box:
      dMassSetBoxTotal(&mass, plan.mass, plan.size.x(), plan.size.y(), plan.size.z());
      break;
    case model::ShapeKind::Sphere:
      dMassSetSphereTotal(&mass, plan.mass, plan.size.x());
      break;
    case model::ShapeKind::Capsule:
      dMassSetCapsuleTotal(&mass, plan.mass, 3, plan.size.x(), plan.size.y());
      break;
  }
  dBodySetMass(body, &mass);
}

dJointID createJoint(dWorldID world, const RobotPlan::Joint& plan, dBodyID child, dBodyID parent) {
  const dJointID joint = dJointCreateHinge(world, nullptr);
  dJointAttach(joint, child, parent);
  dJointSetHingeAnchor(joint, plan.anchor.x(), plan.anchor.y(), plan.anchor.z());
  dJointSetHingeAxis(joint, plan.axis.x(), plan.axis.y(), plan.axis.z());
  dJointSetHingeParam(joint, dParamFMax, kMotorTorque);
  dJointSetHingeParam(joint, dParamCFM, kMotorCfm);
  dJointSetHingeParam(joint, dParamStopCFM, kMotorCfm);
  dJointSetHingeParam(joint, dParamStopERP, kStopErp);
  dJointSetHingeParam(joint, dParamFudgeFactor, kMotorFudgeFactor);
  dJointSetHingeParam(joint, dParamBounce, kStopBounce);
  dJointSetHingeParam(joint, dParamLoStop, plan.lowStop);
  dJointSetHingeParam(joint, dParamHiStop, plan.highStop);
  return joint;
}

void copyNumbers(const dReal* from, const dReal* to, int count) {
  std::copy_n(from, count, const_cast<dReal*>(to));  // ODE hands out pointers into the body
}

}  // namespace

const RobotPlan& robotPlan(int type) {
  static const std::array<RobotPlan, model::kRobotTypeCount> plans{makePlan(0), makePlan(1), makePlan(2),
                                                                   makePlan(3), makePlan(4)};
  return plans.at(static_cast<std::size_t>(type));
}

OdeWorld::OdeWorld()
    : world_((prepareOdeThread(), dWorldCreate())),
      contactJoints_(dJointGroupCreate(0)),
      threading_(dThreadingAllocateSelfThreadedImplementation()) {
  dWorldSetStepThreadingImplementation(world_, dThreadingImplementationGetFunctions(threading_), threading_);
  dWorldSetGravity(world_, 0.0, 0.0, -kGravity);
  dWorldSetCFM(world_, kWorldCfm);
  dWorldSetAutoDisableFlag(world_, 1);
  dWorldSetContactSurfaceLayer(world_, kSurfaceLayer);
}

OdeWorld::~OdeWorld() {
  dJointGroupDestroy(contactJoints_);
  dWorldDestroy(world_);  // with its bodies and joints
  dThreadingFreeImplementation(threading_);
}

Mechanism buildMechanism(dWorldID world, const RobotPlan& plan) {
  Mechanism mechanism;
  for (const RobotPlan::Body& part : plan.bodies) {
    const dBodyID body = dBodyCreate(world);
    placeBody(body, part.pose);
    setMass(body, part);
    mechanism.bodies.push_back(body);
    if (part.joint) {
      mechanism.joints.push_back(createJoint(world, *part.joint, body, mechanism.bodies[part.joint->parent]));
    }
  }
  return mechanism;
}

double Mechanism::angle(std::size_t joint) const {
  if (knownAngles.empty()) knownAngles.resize(joints.size());
  KnownAngle& known = knownAngles[joint];
  if (known.turns != turns) known = {dJointGetHingeAngle(joints[joint]), turns};
  return known.angle;
}

Mechanism buildBall(dWorldID world, float radius, float mass) {
  const dBodyID body = dBodyCreate(world);
  placeBody(body, {Eigen::Matrix3f::Identity(), {0.0F, 0.0F, radius}});
  dMass sphere;
  dMassSetSphereTotal(&sphere, mass, radius);
  dBodySetMass(body, &sphere);
  Mechanism ball;
  ball.bodies = {body};
  return ball;
}

void copyBody(dBodyID from, dBodyID to) {
  copyNumbers(dBodyGetPosition(from), dBodyGetPosition(to), 3);
  copyNumbers(dBodyGetQuaternion(from), dBodyGetQuaternion(to), 4);
  copyNumbers(dBodyGetRotation(from), dBodyGetRotation(to), 12);
  copyNumbers(dBodyGetLinearVel(from), dBodyGetLinearVel(to), 3);
  copyNumbers(dBodyGetAngularVel(from), dBodyGetAngularVel(to), 3);
  copyNumbers(dBodyGetForce(from), dBodyGetForce(to), 3);
  copyNumbers(dBodyGetTorque(from), dBodyGetTorque(to), 3);
}

void copyState(const Mechanism& from, const Mechanism& to) {
  for (std::size_t i = 0; i < from.bodies.size(); ++i) copyBody(from.bodies[i], to.bodies[i]);
  for (std::size_t i = 0; i < from.joints.size(); ++i) {
    dJointSetHingeParam(to.joints[i], dParamVel, dJointGetHingeParam(from.joints[i], dParamVel));
  }
}

}  // namespace nonet::sim
