#include "nonet/model/robot_model.h"

#include <stdexcept>
#include <string>

#include "nonet/math/angle.h"

namespace nonet::model {

namespace {

// Server facts 2.1, in the server's axes (x right, y forward, z up).
struct TypeParameters {
  double hipX;
  double thighZ;
  double ankleZ;
  double elbowY;
  double anklePitchSpeed;  // rad/s
  double ankleRollSpeed;   // rad/s
};

constexpr std::array<TypeParameters, kRobotTypeCount> kTypes{{
    {0.055, -0.04, -0.055, 0.07, 6.1395, 6.1395},
    {0.055, -0.05832, -0.07332, 0.10664, 6.1395, 6.1395},
    {0.055, -0.04, -0.055, 0.07, 8.80667, 3.47234},
    {0.072954143, -0.067868424, -0.082868424, 0.125736848, 6.1395, 6.1395},
    {0.055, -0.04, -0.055, 0.07, 6.1395, 6.1395},
}};

constexpr double kJointSpeed = toRadians(351.77);  // rad/s, all joints but the ankle

// Vectors are written below as in the server facts; here they become the robot's x forward, y left, z up.
Vector3 fromServer(double x, double y, double z) {
  return {y, -x, z};
}

Shape box(double x, double y, double z) {
  return {ShapeKind::Box, {y, x, z}};
}
Shape sphere(double radius) {
  return {ShapeKind::Sphere, {radius, 0.0, 0.0}};
}
Shape capsule(double radius, double cylinderLength) {
  return {ShapeKind::Capsule, {radius, cylinderLength, 0.0}};
}

// Solid capsule along z, as ODE's dMassSetCapsuleTotal has it: a cylinder and two half spheres whose masses
// share the total by volume; the half spheres' centres lie 3/8 radius beyond the cylinder's ends.
Matrix3 capsuleInertia(double mass, double radius, double length) {
  const double cylinderVolume = kPi * radius * radius * length;
  const double ballVolume = 4.0 / 3.0 * kPi * radius * radius * radius;
  const double cylinder = mass * cylinderVolume / (cylinderVolume + ballVolume);
  const double ball = mass * ballVolume / (cylinderVolume + ballVolume);
  const double across = cylinder * (0.25 * radius * radius + length * length / 12.0) +
                        ball * (0.4 * radius * radius + 0.375 * radius * length + 0.25 * length * length);
  const double along = (0.5 * cylinder + 0.4 * ball) * radius * radius;
  return Vector3(across, across, along).asDiagonal();
}

Matrix3 solidInertia(const Shape& shape, double mass) {
  switch (shape.kind) {
    case ShapeKind::Box: {
      const Vector3 square = shape.size.cwiseAbs2();
      return (mass / 12.0 *
              Vector3(square.y() + square.z(), square.x() + square.z(), square.x() + square.y()))
          .asDiagonal();
    }
    case ShapeKind::Sphere:
      return 0.4 * mass * shape.size.x() * shape.size.x() * Matrix3::Identity();
    case ShapeKind::Capsule:
      return capsuleInertia(mass, shape.size.x(), shape.size.y());
  }
  return Matrix3::Zero();
}

struct Limits {
  double low;   // deg
  double high;  // deg
};

// Builds the two lists limb by limb, in the server's order of creation.
class Assembly {
 public:
  Assembly(std::vector<BodySpec>& bodies, std::vector<JointSpec>& joints)
      : bodies_(bodies), joints_(joints) {}

  void body(BodyId id, BodyId parent, const Shape& shape, double mass, bool collider, const Vector3& offset) {
    BodySpec spec;
    spec.id = id;
    spec.parent = parent;
    spec.shape = shape;
    spec.mass = mass;
    spec.collider = collider;
    spec.offset = offset;
    for (const BodySpec& other : bodies_) {
      if (other.id == parent) spec.p_RB = other.p_RB + offset;
    }
    spec.inertia = solidInertia(shape, mass);
    bodies_.push_back(spec);
  }

  /// Puts a joint between the newest body and its parent.
  void joint(JointId id, const Vector3& anchor, const Vector3& axis, Limits degrees, double maxSpeed) {
    BodySpec& child = bodies_.back();
    child.joint = id;
    joints_.push_back({id, child.id, child.parent, anchor, axis, toRadians(degrees.low),
                       toRadians(degrees.high), maxSpeed});
  }

 private:
  std::vector<BodySpec>& bodies_;
  std::vector<JointSpec>& joints_;
};

void addTrunk(Assembly& robot) {
  robot.body(BodyId::Torso, BodyId::Torso, box(0.1, 0.1, 0.18), 1.2171, true, Vector3::Zero());
  robot.body(BodyId::Neck, BodyId::Torso, capsule(0.015, 0.08), 0.05, true, fromServer(0, 0, 0.09));
  robot.joint(JointId::Head1, Vector3::Zero(), fromServer(0, 0, 1), {-120, 120}, kJointSpeed);
  robot.body(BodyId::Head, BodyId::Neck, sphere(0.065), 0.35, true, fromServer(0, 0, 0.065));
  robot.joint(JointId::Head2, fromServer(0, 0, -0.005), fromServer(1, 0, 0), {-45, 45}, kJointSpeed);
}

// The limits of the joints that turn about z or y are mirrored on the left side.
Limits mirror(Limits limits, bool left) {
  return left ? Limits{-limits.high, -limits.low} : limits;
}

void addArm(Assembly& robot, const TypeParameters& type, bool left) {
  const double side = left ? -1.0 : 1.0;
  const auto body = [left](BodyId right) {
    return left ? bodyAt(index(right) + index(BodyId::LShoulder) - index(BodyId::RShoulder)) : right;
  };
  const auto joint = [left](JointId right) {
    return left ? jointAt(index(right) + index(JointId::LArm1) - index(JointId::RArm1)) : right;
  };
  robot.body(body(BodyId::RShoulder), BodyId::Torso, sphere(0.01), 0.07, false,
             fromServer(side * 0.098, 0, 0.075));
  robot.joint(joint(JointId::RArm1), Vector3::Zero(), fromServer(1, 0, 0), {-120, 120}, kJointSpeed);
  robot.body(body(BodyId::RUpperArm), body(BodyId::RShoulder), box(0.07, 0.08, 0.06), 0.15, true,
             fromServer(side * 0.01, 0.02, 0));
  robot.joint(joint(JointId::RArm2), fromServer(side * -0.01, -0.02, 0), fromServer(0, 0, 1),
              mirror({-95, 1}, left), kJointSpeed);
  robot.body(body(BodyId::RElbow), body(BodyId::RUpperArm), sphere(0.01), 0.035, false,
             fromServer(side * -0.01, type.elbowY, 0.009));
  robot.joint(joint(JointId::RArm3), Vector3::Zero(), fromServer(0, 1, 0), {-120, 120}, kJointSpeed);
  robot.body(body(BodyId::RLowerArm), body(BodyId::RElbow), box(0.05, 0.11, 0.05), 0.2, true,
             fromServer(0, 0.05, 0));
  robot.joint(joint(JointId::RArm4), fromServer(0, -0.05, 0), fromServer(0, 0, 1), mirror({-1, 90}, left),
              kJointSpeed);
}

void addLeg(Assembly& robot, const TypeParameters& type, bool left, bool toe) {
  const double side = left ? -1.0 : 1.0;
  const auto body = [left](BodyId right) {
    return left ? bodyAt(index(right) + index(BodyId::LHip1) - index(BodyId::RHip1)) : right;
  };
  const auto joint = [left](JointId right) {
    return left ? jointAt(index(right) + index(JointId::LLeg1) - index(JointId::RLeg1)) : right;
  };
  robot.body(body(BodyId::RHip1), BodyId::Torso, sphere(0.01), 0.09, false,
             fromServer(side * type.hipX, -0.01, -0.115));
  robot.joint(joint(JointId::RLeg1), Vector3::Zero(), fromServer(-0.7071, 0, side * 0.7071), {-90, 1},
              kJointSpeed);
  robot.body(body(BodyId::RHip2), body(BodyId::RHip1), sphere(0.01), 0.125, false, Vector3::Zero());
  robot.joint(joint(JointId::RLeg2), Vector3::Zero(), fromServer(0, 1, 0), mirror({-45, 25}, left),
              kJointSpeed);
  robot.body(body(BodyId::RThigh), body(BodyId::RHip2), box(0.07, 0.07, 0.14), 0.275, true,
             fromServer(0, 0.01, type.thighZ));
  robot.joint(joint(JointId::RLeg3), fromServer(0, -0.01, -type.thighZ), fromServer(1, 0, 0), {-25, 100},
              kJointSpeed);
  robot.body(body(BodyId::RShank), body(BodyId::RThigh), box(0.08, 0.07, 0.11), 0.225, true,
             fromServer(0, 0.005, -0.125));
  robot.joint(joint(JointId::RLeg4), fromServer(0, -0.01, 0.045), fromServer(1, 0, 0), {-130, 1},
              kJointSpeed);
  robot.body(body(BodyId::RAnkle), body(BodyId::RShank), sphere(0.01), 0.125, false,
             fromServer(0, -0.01, type.ankleZ));
  robot.joint(joint(JointId::RLeg5), Vector3::Zero(), fromServer(1, 0, 0), {-45, 75}, type.anklePitchSpeed);
  // Type 4: the toe takes its share of the foot's length and mass (server facts 2.2, table of type 4).
  if (toe) {
    robot.body(body(BodyId::RFoot), body(BodyId::RAnkle), box(0.08, 0.124482344, 0.02), 0.177801465, true,
               fromServer(0, 0.012241172, -0.04));
  } else {
    robot.body(body(BodyId::RFoot), body(BodyId::RAnkle), box(0.08, 0.16, 0.02), 0.2, true,
               fromServer(0, 0.03, -0.04));
  }
  robot.joint(joint(JointId::RLeg6), fromServer(0, -0.03, 0.035), fromServer(0, 1, 0),
              mirror({-25, 45}, left), type.ankleRollSpeed);
  if (toe) {
    robot.body(body(BodyId::RToe), body(BodyId::RFoot), box(0.08, 0.035517656, 0.01), 0.022198535, true,
               fromServer(0, 0.08, -0.005));
    robot.joint(joint(JointId::RLeg7), fromServer(0, -0.017758828, -0.005), fromServer(1, 0, 0), {-1, 70},
                kJointSpeed);
  }
}

}  // namespace

RobotModel::RobotModel(int type) : type_(type) {
  if (type < 0 || type >= kRobotTypeCount) {
    throw std::out_of_range("robot type " + std::to_string(type) + " does not exist: use 0..4");
  }
  bodies_.reserve(kBodyCount);
  joints_.reserve(kJointCount);
  Assembly robot(bodies_, joints_);
  addTrunk(robot);
  addArm(robot, kTypes[type], false);
  addArm(robot, kTypes[type], true);
  addLeg(robot, kTypes[type], false, hasToes());
  addLeg(robot, kTypes[type], true, hasToes());

  bodyIndex_.fill(-1);
  jointIndex_.fill(-1);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    bodyIndex_[index(bodies_[i].id)] = static_cast<int>(i);
    totalMass_ += bodies_[i].mass;
  }
  for (std::size_t i = 0; i < joints_.size(); ++i) jointIndex_[index(joints_[i].id)] = static_cast<int>(i);
  const BodySpec& foot = body(BodyId::RFoot);
  standingHeight_ = -foot.p_RB.z() + 0.5 * foot.shape.size.z();
}

const RobotModel& robotModel(int type) {
  static const std::array<RobotModel, kRobotTypeCount> models{RobotModel(0), RobotModel(1), RobotModel(2),
                                                              RobotModel(3), RobotModel(4)};
  if (type < 0 || type >= kRobotTypeCount) {
    throw std::out_of_range("robot type " + std::to_string(type) + " does not exist: use 0..4");
  }
  return models[type];
}

}  // namespace nonet::model
