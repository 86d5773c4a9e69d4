#include "nonet/model/kinematics.h"

#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <zlib.h>

#include "nonet/math/angle.h"
#include "nonet/math/random.h"

#include "random_pose.h"

namespace nonet::model {
namespace {

std::string readGzip(const std::string& path) {
  std::string text;
  gzFile file = gzopen(path.c_str(), "rb");
  if (file == nullptr) return text;
  char buffer[8192];
  int count = 0;
  while ((count = gzread(file, buffer, sizeof buffer)) > 0) text.append(buffer, count);
  gzclose(file);
  return text;
}

// A recorded matrix (body axes x right, y forward, z up; column major) with the robot's axes.
Pose3 recordedPose(const nlohmann::json& matrix) {
  Matrix3 server;
  Pose3 pose = Pose3::Identity();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) server(row, column) = matrix[4 * column + row];
    pose.translation()[row] = matrix[12 + row];
  }
  pose.linear() << server.col(1), -server.col(0), server.col(2);
  return pose;
}

// Bodies of the real server's robot, recorded with its joint angles.
//
// Tolerances. Angles are printed to 0.01 degrees: 8.7e-5 rad for each turned joint, at a lever of at most
// 0.4 m 3.5e-5 m. Matrices have six digits: 5e-5 m per coordinate at 29 m height (1e-4 m in a difference),
// 1e-6 in the rotation. The remainder is the server's soft hinges: in a pulse of 2 rad/s the centripetal
// force of a whole leg opens them by up to 0.5 mm and 2e-4 rad; at rest they are closed. A sign, an axis or
// an anchor that is wrong by 2 mm shows as more than that.
TEST(Kinematics, AgreesWithTheRecordedServer) {
  const std::string text = readGzip(NONET_TEST_DATA "/model/recorded_poses.jsonl.gz");
  ASSERT_FALSE(text.empty());
  const RobotModel& model = robotModel(0);
  int rows = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    const auto row = nlohmann::json::parse(text.substr(begin, end - begin));
    begin = end + 1;
    ++rows;
    const bool moving = row["scenario"] == "joint_pulses_air";
    JointArray angles{};
    for (const JointSpec& joint : model.joints()) {
      angles[index(joint.id)] = toRadians(row["hj"][std::string(perceptorName(joint.id))].get<double>());
    }
    BodyPoses poses;
    forwardKinematics(model, angles, poses);
    const Pose3 X_WR = recordedPose(row["parts"]["torso"]);
    for (const BodySpec& body : model.bodies()) {
      const Pose3 X_WB = recordedPose(row["parts"][std::string(bodyName(body.id))]);
      const Vector3 p_RB = X_WR.linear().transpose() * (X_WB.translation() - X_WR.translation());
      const Matrix3 R_RB = X_WR.linear().transpose() * X_WB.linear();
      const Pose3& computed = poses[index(body.id)];
      EXPECT_LT((p_RB - computed.translation()).norm(), moving ? 7e-4 : 1.5e-4)
          << row["scenario"] << ' ' << row["t"] << ' ' << bodyName(body.id);
      EXPECT_LT((R_RB - computed.linear()).cwiseAbs().maxCoeff(), moving ? 3e-4 : 1.5e-4)
          << row["scenario"] << ' ' << row["t"] << ' ' << bodyName(body.id);
    }
  }
  EXPECT_EQ(rows, 28);
}

TEST(Kinematics, ZeroPoseIsTheTableOfPositions) {
  for (int type = 0; type < kRobotTypeCount; ++type) {
    const RobotModel& model = robotModel(type);
    BodyPoses poses;
    forwardKinematics(model, JointArray{}, poses);
    for (const BodySpec& body : model.bodies()) {
      EXPECT_LT((poses[index(body.id)].translation() - body.p_RB).norm(), 1e-15);
      EXPECT_LT((poses[index(body.id)].linear() - Matrix3::Identity()).norm(), 1e-15);
    }
    for (const Side side : {Side::Left, Side::Right}) {
      const Pose3 X_RS = solePose(model, poses, side);
      EXPECT_NEAR(X_RS.translation().z(), -model.standingHeight(), 1e-12);
      // Below the ankle, which is 0.5 cm behind the torso's centre (server facts 2.2).
      EXPECT_NEAR(X_RS.translation().x(), -0.005, 1e-12);
    }
  }
}

// A second algorithm: turn the whole sub-tree of each joint about its axis line, from the leaves to the torso
// (product of exponentials), with axis lines in the zero pose.
TEST(Kinematics, AgreesWithTheProductOfExponentials) {
  Random random(11);
  for (int type = 0; type < kRobotTypeCount; ++type) {
    const RobotModel& model = robotModel(type);
    for (int trial = 0; trial < 200; ++trial) {
      const JointArray angles = randomAngles(model, random);
      BodyPoses poses;
      forwardKinematics(model, angles, poses);
      for (const BodySpec& body : model.bodies()) {
        Pose3 X_RB(Eigen::Translation3d(body.p_RB));
        const BodySpec* link = &body;
        while (link->joint) {
          const JointSpec& joint = model.joint(*link->joint);
          const Vector3 p_RA = link->p_RB + joint.anchor;
          const Eigen::AngleAxisd turn(angles[index(joint.id)], joint.axis.normalized());
          X_RB = Eigen::Translation3d(p_RA) * turn * Eigen::Translation3d(-p_RA) * X_RB;
          link = &model.body(link->parent);
        }
        EXPECT_LT((X_RB.matrix() - poses[index(body.id)].matrix()).cwiseAbs().maxCoeff(), 1e-14);
      }
    }
  }
}

TEST(Kinematics, MirroredAnglesGiveTheMirroredPose) {
  Random random(12);
  const Eigen::DiagonalMatrix<double, 3> flip(1.0, -1.0, 1.0);
  for (int type = 0; type < kRobotTypeCount; ++type) {
    const RobotModel& model = robotModel(type);
    const JointArray angles = randomAngles(model, random);
    JointArray twin{};
    for (const JointSpec& joint : model.joints()) {
      // Joints about y and the hip yaw-pitch keep their sign; those about x or z change it.
      const bool keeps = joint.axis.x() == 0.0 && joint.axis.y() != 0.0;
      twin[index(mirrored(joint.id))] = (keeps ? 1.0 : -1.0) * angles[index(joint.id)];
    }
    BodyPoses poses;
    BodyPoses mirroredPoses;
    forwardKinematics(model, angles, poses);
    forwardKinematics(model, twin, mirroredPoses);
    const Pose3 left = solePose(model, poses, Side::Left);
    const Pose3 right = solePose(model, mirroredPoses, Side::Right);
    EXPECT_LT((flip * left.translation() - right.translation()).norm(), 1e-14);
    EXPECT_LT((flip * left.linear() * flip - right.linear()).norm(), 1e-14);
    EXPECT_LT((flip * centerOfMass(model, poses) - centerOfMass(model, mirroredPoses)).norm(), 1e-14);
  }
}

// Oracle: the derivative of the centre of mass by one joint is the mass of the sub-tree behind it, turning
// about the joint's axis line.
TEST(Kinematics, CentreOfMassMovesWithItsSubTree) {
  Random random(13);
  const RobotModel& model = robotModel(4);
  for (int trial = 0; trial < 20; ++trial) {
    JointArray angles = randomAngles(model, random);
    BodyPoses poses;
    forwardKinematics(model, angles, poses);
    for (const JointSpec& joint : model.joints()) {
      const Pose3& X_RB = poses[index(joint.child)];
      const Vector3 axis = X_RB.linear() * joint.axis.normalized();
      const Vector3 anchor = X_RB * joint.anchor;
      Vector3 expected = Vector3::Zero();
      for (const BodySpec& body : model.bodies()) {
        const BodySpec* link = &body;
        while (link->id != joint.child && link->joint) link = &model.body(link->parent);
        if (link->id != joint.child) continue;
        expected += body.mass * axis.cross(poses[index(body.id)].translation() - anchor);
      }
      expected /= model.totalMass();
      const double step = 1e-5;
      const double angle = angles[index(joint.id)];
      BodyPoses moved;
      angles[index(joint.id)] = angle + step;
      forwardKinematics(model, angles, moved);
      const Vector3 plus = centerOfMass(model, moved);
      angles[index(joint.id)] = angle - step;
      forwardKinematics(model, angles, moved);
      angles[index(joint.id)] = angle;
      const Vector3 derivative = (plus - centerOfMass(model, moved)) / (2.0 * step);
      EXPECT_LT((derivative - expected).norm(), 1e-9) << perceptorName(joint.id);
    }
  }
}

}  // namespace
}  // namespace nonet::model
