#include "nonet/model/robot_model.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "nonet/math/angle.h"
#include "nonet/math/random.h"

namespace nonet::model {
namespace {

// Server facts 2.1, last row of the table, written there with six digits.
TEST(RobotModel, StandsAsHighAsTheFactsSay) {
  const double heights[] = {0.385, 0.42164, 0.385, 0.440737, 0.385};
  for (int type = 0; type < kRobotTypeCount; ++type) {
    EXPECT_NEAR(robotModel(type).standingHeight(), heights[type], 5e-7) << "type " << type;
  }
}

TEST(RobotModel, AllTypesHaveTheSameMass) {
  for (int type = 0; type < kRobotTypeCount; ++type) {
    EXPECT_NEAR(robotModel(type).totalMass(), 4.6071, 1e-9) << "type " << type;
  }
}

// The last column of the table in server facts 2.2 is an independent sum of the offsets.
TEST(RobotModel, BodyPositionsAgreeWithTheTable) {
  struct Row {
    BodyId right;
    Vector3 server;  // x right, y forward, z up
  };
  const Row rows[] = {{BodyId::RShoulder, {0.098, 0, 0.075}},   {BodyId::RUpperArm, {0.108, 0.02, 0.075}},
                      {BodyId::RElbow, {0.098, 0.09, 0.084}},   {BodyId::RLowerArm, {0.098, 0.14, 0.084}},
                      {BodyId::RHip1, {0.055, -0.01, -0.115}},  {BodyId::RHip2, {0.055, -0.01, -0.115}},
                      {BodyId::RThigh, {0.055, 0, -0.155}},     {BodyId::RShank, {0.055, 0.005, -0.28}},
                      {BodyId::RAnkle, {0.055, -0.005, -0.335}}};
  for (const int type : {0, 2, 4}) {
    const RobotModel& model = robotModel(type);
    for (const Row& row : rows) {
      const Vector3 right(row.server.y(), -row.server.x(), row.server.z());
      EXPECT_LT((model.body(row.right).p_RB - right).norm(), 1e-12) << bodyName(row.right);
    }
    EXPECT_LT((model.body(BodyId::Head).p_RB - Vector3(0, 0, 0.155)).norm(), 1e-12);
  }
  EXPECT_LT((robotModel(0).body(BodyId::RFoot).p_RB - Vector3(0.025, -0.055, -0.375)).norm(), 1e-12);
  // Types 1 and 3: the numbers of the text under the table (six digits).
  const RobotModel& one = robotModel(1);
  EXPECT_NEAR(one.body(BodyId::RElbow).p_RB.x(), 0.12664, 1e-12);
  EXPECT_NEAR(one.body(BodyId::RLowerArm).p_RB.x(), 0.17664, 1e-12);
  EXPECT_NEAR(one.body(BodyId::RThigh).p_RB.z(), -0.17332, 1e-12);
  EXPECT_NEAR(one.body(BodyId::RFoot).p_RB.z(), -0.41164, 1e-12);
  const RobotModel& three = robotModel(3);
  EXPECT_NEAR(three.body(BodyId::LElbow).p_RB.x(), 0.145737, 5e-7);
  EXPECT_NEAR(three.body(BodyId::LFoot).p_RB.y(), 0.072954, 5e-7);
  EXPECT_NEAR(three.body(BodyId::LShank).p_RB.z(), -0.307868, 5e-7);
  EXPECT_NEAR(three.body(BodyId::LFoot).p_RB.z(), -0.430737, 5e-7);
}

TEST(RobotModel, LeftMirrorsRight) {
  for (int type = 0; type < kRobotTypeCount; ++type) {
    const RobotModel& model = robotModel(type);
    for (const JointSpec& joint : model.joints()) {
      const JointSpec& twin = model.joint(mirrored(joint.id));
      if (joint.id == twin.id) continue;
      EXPECT_EQ(joint.anchor, Vector3(twin.anchor.x(), -twin.anchor.y(), twin.anchor.z()));
      EXPECT_EQ(joint.maxSpeed, twin.maxSpeed);
      const BodySpec& body = model.body(joint.child);
      const BodySpec& twinBody = model.body(twin.child);
      EXPECT_EQ(body.p_RB, Vector3(twinBody.p_RB.x(), -twinBody.p_RB.y(), twinBody.p_RB.z()));
      EXPECT_EQ(body.mass, twinBody.mass);
      // A turn by q about the axis, mirrored in the plane y = 0, is one by s q about the mirrored axis: the
      // limits belong together with that sign.
      const Vector3 reflected(-twin.axis.x(), twin.axis.y(), -twin.axis.z());
      const double sign = joint.axis.dot(reflected) > 0.0 ? 1.0 : -1.0;
      EXPECT_EQ(joint.axis, sign * reflected);
      EXPECT_EQ(joint.low, sign > 0 ? twin.low : -twin.high) << perceptorName(joint.id);
      EXPECT_EQ(joint.high, sign > 0 ? twin.high : -twin.low) << perceptorName(joint.id);
    }
  }
}

TEST(RobotModel, ListsAreInTheServersOrder) {
  for (int type = 0; type < kRobotTypeCount; ++type) {
    const RobotModel& model = robotModel(type);
    EXPECT_EQ(model.bodies().size(), type == 4 ? 25U : 23U);
    EXPECT_EQ(model.joints().size(), type == 4 ? 24U : 22U);
    EXPECT_TRUE(std::is_sorted(model.joints().begin(), model.joints().end(),
                               [](const auto& a, const auto& b) { return a.id < b.id; }));
    std::array<bool, kBodyCount> made{};
    for (const BodySpec& body : model.bodies()) {
      EXPECT_TRUE(body.id == BodyId::Torso || made[index(body.parent)]) << bodyName(body.id);
      made[index(body.id)] = true;
      if (body.joint) {
        EXPECT_EQ(model.joint(*body.joint).child, body.id);
        EXPECT_EQ(model.joint(*body.joint).parent, body.parent);
      }
    }
    EXPECT_EQ(model.has(JointId::RLeg7), type == 4);
    EXPECT_EQ(model.has(BodyId::LToe), type == 4);
  }
  EXPECT_DOUBLE_EQ(robotModel(2).joint(JointId::LLeg5).maxSpeed, 8.80667);
  EXPECT_DOUBLE_EQ(robotModel(2).joint(JointId::RLeg6).maxSpeed, 3.47234);
  EXPECT_NEAR(robotModel(0).joint(JointId::Head1).maxSpeed, 6.139545, 5e-7);
  EXPECT_NEAR(toDegrees(robotModel(0).joint(JointId::RLeg3).high), 100.0, 1e-12);
}

TEST(RobotModel, TheToeContinuesTheFootAndItsSoleIsLevel) {
  const RobotModel& model = robotModel(4);
  const BodySpec& foot = model.body(BodyId::RFoot);
  const BodySpec& toe = model.body(BodyId::RToe);
  EXPECT_NEAR(foot.p_RB.x() + foot.shape.size.x() / 2, toe.p_RB.x() - toe.shape.size.x() / 2, 1e-9);
  EXPECT_NEAR(foot.p_RB.z() - foot.shape.size.z() / 2, toe.p_RB.z() - toe.shape.size.z() / 2, 1e-12);
  // Together as long as the foot of the other types.
  EXPECT_NEAR(foot.shape.size.x() + toe.shape.size.x(), 0.16, 1e-9);
  EXPECT_NEAR(foot.p_RB.x() - foot.shape.size.x() / 2, robotModel(0).body(BodyId::RFoot).p_RB.x() - 0.08,
              1e-9);
}

TEST(RobotModel, UnknownTypeIsRefused) {
  EXPECT_THROW(robotModel(-1), std::out_of_range);
  EXPECT_THROW(robotModel(5), std::out_of_range);
}

bool inside(const Shape& shape, const Vector3& p) {
  switch (shape.kind) {
    case ShapeKind::Box:
      return (p.cwiseAbs() - shape.size / 2).maxCoeff() <= 0.0;
    case ShapeKind::Sphere:
      return p.norm() <= shape.size.x();
    case ShapeKind::Capsule: {
      const double half = shape.size.y() / 2;
      return (p - Vector3(0, 0, std::clamp(p.z(), -half, half))).norm() <= shape.size.x();
    }
  }
  return false;
}

// Oracle: the inertia of a solid is the mean of |p|^2 I - p p^T over its volume, here by throwing darts.
TEST(RobotModel, InertiaIsThatOfTheSolid) {
  Random random(7);
  for (const BodyId id : {BodyId::Torso, BodyId::Neck, BodyId::Head, BodyId::RFoot, BodyId::LUpperArm}) {
    const BodySpec& body = robotModel(0).body(id);
    const double reach = id == BodyId::Neck ? 0.055 : 0.09;
    Matrix3 sum = Matrix3::Zero();
    int count = 0;
    while (count < 100000) {
      const Vector3 p(random.uniform(-reach, reach), random.uniform(-reach, reach),
                      random.uniform(-reach, reach));
      if (!inside(body.shape, p)) continue;
      sum += p.squaredNorm() * Matrix3::Identity() - p * p.transpose();
      ++count;
    }
    const Matrix3 expected = body.mass * sum / count;
    // The mean of 100,000 darts is good to about 0.3 %; five deviations allowed.
    EXPECT_LT((body.inertia - expected).cwiseAbs().maxCoeff(), 0.015 * body.inertia.diagonal().maxCoeff())
        << bodyName(id);
  }
}

}  // namespace
}  // namespace nonet::model
