#include "nonet/model/inverse_kinematics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "nonet/math/angle.h"
#include "nonet/model/kinematics.h"
#include "nonet/model/numeric_inverse_kinematics.h"

#include "model/limb.h"
#include "random_pose.h"

namespace nonet::model {
namespace {

#ifdef __SANITIZE_ADDRESS__
constexpr int kPosesPerLimb = 1000;  // the sanitizers make it twenty times slower
#else
constexpr int kPosesPerLimb = 10000;  // times five types and two sides: 100,000
#endif

Pose3 soleOf(const RobotModel& model, Side side, const LegAngles& leg) {
  JointArray angles{};
  setLegAngles(side, leg, angles);
  BodyPoses poses;
  forwardKinematics(model, angles, poses);
  return solePose(model, poses, side);
}

Vector3 handOf(const RobotModel& model, Side side, const ArmAngles& arm) {
  JointArray angles{};
  setArmAngles(side, arm, angles);
  BodyPoses poses;
  forwardKinematics(model, angles, poses);
  return poses[index(side == Side::Left ? BodyId::LLowerArm : BodyId::RLowerArm)].translation();
}

/// The distance that the fits make least, from forwardKinematics alone.
double distance(const Pose3& a, const Pose3& b) {
  const double angle = Eigen::AngleAxisd(Matrix3(a.linear().transpose() * b.linear())).angle();
  return std::hypot((a.translation() - b.translation()).norm(),
                    kOrientationLever * 2.0 * std::sin(angle / 2.0));
}

template <std::size_t N>
std::array<double, N> limbAngles(JointId first, const JointArray& angles) {
  std::array<double, N> limb{};
  for (std::size_t i = 0; i < N; ++i) limb[i] = angles[index(first) + i];
  return limb;
}

JointId firstJoint(Side side, bool leg) {
  if (leg) return side == Side::Left ? JointId::LLeg1 : JointId::RLeg1;
  return side == Side::Left ? JointId::LArm1 : JointId::RArm1;
}

template <std::size_t N>
void expectWithinLimits(const RobotModel& model, JointId first, const std::array<double, N>& limb) {
  for (std::size_t i = 0; i < N; ++i) {
    const JointSpec& joint = model.joint(jointAt(index(first) + i));
    EXPECT_GE(limb[i], joint.low);
    EXPECT_LE(limb[i], joint.high);
  }
}

TEST(LegInverseKinematics, FindsTheAnglesOfRandomPosesOfAllTypes) {
  Random random(21);
  for (int type = 0; type < kRobotTypeCount; ++type) {
    const RobotModel& model = robotModel(type);
    for (const Side side : {Side::Left, Side::Right}) {
      double worstPosition = 0.0;
      double worstRotation = 0.0;
      double worstAngle = 0.0;
      int exact = 0;
      for (int trial = 0; trial < kPosesPerLimb; ++trial) {
        const LegAngles truth = limbAngles<6>(firstJoint(side, true), randomAngles(model, random));
        const Pose3 target = soleOf(model, side, truth);
        LegAngles found{};
        if (legInverseKinematics(model, side, target, found) == Reach::Exact) ++exact;
        const Pose3 reached = soleOf(model, side, found);
        worstPosition = std::max(worstPosition, (reached.translation() - target.translation()).norm());
        worstRotation = std::max(worstRotation, (reached.linear() - target.linear()).cwiseAbs().maxCoeff());
        // Within the limits the solution is unique.
        for (std::size_t i = 0; i < 6; ++i) worstAngle = std::max(worstAngle, std::abs(found[i] - truth[i]));
      }
      EXPECT_EQ(exact, kPosesPerLimb) << "type " << type;
      EXPECT_LT(worstPosition, 1e-9) << "type " << type;
      EXPECT_LT(worstRotation, 1e-9) << "type " << type;
      EXPECT_LT(worstAngle, 1e-7) << "type " << type;
    }
  }
}

TEST(LegInverseKinematics, TheCornersOfTheLimitsAreExact) {
  for (int type = 0; type < kRobotTypeCount; ++type) {
    const RobotModel& model = robotModel(type);
    for (const Side side : {Side::Left, Side::Right}) {
      for (unsigned corner = 0; corner < 64; ++corner) {
        LegAngles truth{};
        for (std::size_t i = 0; i < 6; ++i) {
          const JointSpec& joint = model.joint(jointAt(index(firstJoint(side, true)) + i));
          truth[i] = ((corner >> i) & 1U) != 0 ? joint.high : joint.low;
        }
        const Pose3 target = soleOf(model, side, truth);
        LegAngles found{};
        EXPECT_EQ(legInverseKinematics(model, side, target, found), Reach::Exact);
        EXPECT_LT(distance(soleOf(model, side, found), target), 1e-9);
        expectWithinLimits(model, firstJoint(side, true), found);
      }
    }
  }
}

// Oracle: finite differences of forward kinematics. A small move of the target changes the angles by the
// inverse of the Jacobian; so J * dq must be the move.
TEST(LegInverseKinematics, DerivativeIsTheInverseOfTheJacobian) {
  Random random(22);
  const RobotModel& model = robotModel(3);
  const double step = 1e-6;
  for (int trial = 0; trial < 300; ++trial) {
    LegAngles truth{};
    for (std::size_t i = 0; i < 6; ++i) {
      const JointSpec& joint = model.joint(jointAt(index(JointId::LLeg1) + i));
      truth[i] = random.uniform(joint.low + 0.1, joint.high - 0.1);
    }
    truth[0] = std::min(truth[0], -0.1);
    // Away from the stretched leg, and from the deep squat with the hip on the ankle's roll axis.
    truth[3] = random.uniform(-1.6, -0.3);
    const Pose3 target = soleOf(model, Side::Left, truth);
    Vector3 direction(random.normal(), random.normal(), random.normal());
    Vector3 axis(random.normal(), random.normal(), random.normal());
    direction.normalize();
    axis.normalize();
    LegAngles plus{};
    LegAngles minus{};
    Pose3 moved = target;
    moved.translation() = target.translation() + step * direction;
    moved.linear() = Eigen::AngleAxisd(step, axis) * target.linear();
    ASSERT_EQ(legInverseKinematics(model, Side::Left, moved, plus), Reach::Exact);
    moved.translation() = target.translation() - step * direction;
    moved.linear() = Eigen::AngleAxisd(-step, axis) * target.linear();
    ASSERT_EQ(legInverseKinematics(model, Side::Left, moved, minus), Reach::Exact);
    // J by finite differences of forward kinematics.
    Vector3 velocity = Vector3::Zero();
    Matrix3 rotation = Matrix3::Zero();
    for (std::size_t i = 0; i < 6; ++i) {
      LegAngles high = truth;
      LegAngles low = truth;
      high[i] += step;
      low[i] -= step;
      const Pose3 a = soleOf(model, Side::Left, high);
      const Pose3 b = soleOf(model, Side::Left, low);
      const double rate = (plus[i] - minus[i]) / (2.0 * step);
      velocity += rate * (a.translation() - b.translation()) / (2.0 * step);
      rotation += rate * (a.linear() - b.linear()) * target.linear().transpose() / (2.0 * step);
    }
    const Vector3 angular(rotation(2, 1), rotation(0, 2), rotation(1, 0));
    EXPECT_LT((velocity - direction).norm(), 1e-5);
    EXPECT_LT((angular - axis).norm(), 1e-5);
  }
}

TEST(LegInverseKinematics, JacobianOfTheLimbAgreesWithFiniteDifferences) {
  Random random(23);
  const RobotModel& model = robotModel(4);
  const double step = 1e-6;
  for (int trial = 0; trial < 100; ++trial) {
    const Limb<6> limb = legLimb(model, Side::Right);
    const LegAngles leg = limbAngles<6>(JointId::RLeg1, randomAngles(model, random));
    const LegAngles other = limbAngles<6>(JointId::RLeg1, randomAngles(model, random));
    const Pose3 target = soleOf(model, Side::Right, other);
    Limb<6>::Angles x = Eigen::Map<const Limb<6>::Angles>(leg.data());
    EXPECT_LT((limb.evaluate(x, nullptr).matrix() - soleOf(model, Side::Right, leg).matrix()).norm(), 1e-14);
    Eigen::Matrix<double, 6, 1> residual;
    Eigen::Matrix<double, 6, 6> derivative;
    PoseResidual::evaluate<6>(limb, x, target, residual, &derivative);
    if (residual.tail<3>().norm() > 1.9 * kOrientationLever) continue;  // kink at half a turn
    for (int i = 0; i < 6; ++i) {
      Limb<6>::Angles moved = x;
      Eigen::Matrix<double, 6, 1> plus;
      Eigen::Matrix<double, 6, 1> minus;
      moved[i] = x[i] + step;
      PoseResidual::evaluate<6>(limb, moved, target, plus, nullptr);
      moved[i] = x[i] - step;
      PoseResidual::evaluate<6>(limb, moved, target, minus, nullptr);
      EXPECT_LT(((plus - minus) / (2.0 * step) - derivative.col(i)).norm(), 1e-8);
    }
  }
}

TEST(LegInverseKinematics, CeresFindsTheSameAngles) {
  Random random(24);
  for (int type = 0; type < kRobotTypeCount; ++type) {
    const RobotModel& model = robotModel(type);
    for (int trial = 0; trial < 40; ++trial) {
      const Side side = trial % 2 == 0 ? Side::Left : Side::Right;
      const LegAngles truth = limbAngles<6>(firstJoint(side, true), randomAngles(model, random));
      const Pose3 target = soleOf(model, side, truth);
      LegAngles numeric = truth;
      for (double& angle : numeric) angle += random.normal(0.0, 0.1);
      const NumericSolution solution = numericLegInverseKinematics(model, side, target, numeric);
      if (solution.distance > 1e-8) continue;  // caught at a limit on its way
      LegAngles closed{};
      EXPECT_EQ(legInverseKinematics(model, side, target, closed), Reach::Exact);
      for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(closed[i], numeric[i], 1e-5);
    }
  }
}

TEST(LegInverseKinematics, TooFarStretchesTheLegTowardsTheTarget) {
  Random random(25);
  for (int type = 0; type < kRobotTypeCount; ++type) {
    const RobotModel& model = robotModel(type);
    // Straight down by 5 cm too much: the foot stays level, below the hip, with the knee at its end.
    JointArray zero{};
    BodyPoses poses;
    forwardKinematics(model, zero, poses);
    Pose3 target = solePose(model, poses, Side::Left);
    target.translation().z() -= 0.05;
    LegAngles leg{};
    ASSERT_EQ(legInverseKinematics(model, Side::Left, target, leg), Reach::TooFar);
    const Pose3 reached = soleOf(model, Side::Left, leg);
    EXPECT_LT((reached.linear() - target.linear()).norm(), 1e-9);
    EXPECT_NEAR(leg[3], toRadians(1.0), 1e-12);
    // Nearest place with this orientation: no other pose of the stretched, level leg comes nearer.
    const double error = (reached.translation() - target.translation()).norm();
    EXPECT_NEAR(error, 0.05, 1e-3);
    for (int trial = 0; trial < 200; ++trial) {
      Pose3 other = target;
      other.translation() += Vector3(random.uniform(-0.03, 0.03), random.uniform(-0.03, 0.03), 0.05);
      LegAngles otherLeg{};
      if (legInverseKinematics(model, Side::Left, other, otherLeg) == Reach::Limited) continue;
      const Pose3 otherReached = soleOf(model, Side::Left, otherLeg);
      EXPECT_GT((otherReached.translation() - target.translation()).norm(), error - 1e-9);
    }
    // Continuous: a target just beyond reach is met almost.
    target.translation().z() += 0.05 - 1e-6;
    legInverseKinematics(model, Side::Left, target, leg);
    EXPECT_LT((soleOf(model, Side::Left, leg).translation() - target.translation()).norm(), 1.1e-3);
  }
}

// Targets that the limits forbid: the answer says so, is within the limits, is a minimum (Ceres, started
// there, finds nothing nearer), and nearly always as near as Ceres gets from several other starts.
TEST(LegInverseKinematics, AtTheLimitsItIsAsNearAsTheNumericSolver) {
  Random random(26);
  int limited = 0;
  int beaten = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const RobotModel& model = robotModel(trial % kRobotTypeCount);
    const Side side = trial % 2 == 0 ? Side::Left : Side::Right;
    // A pose near the limits, pushed by up to 0.35 rad beyond them.
    LegAngles truth = limbAngles<6>(firstJoint(side, true), randomAngles(model, random));
    for (double& angle : truth) angle += random.uniform(-0.35, 0.35);
    const Pose3 target = soleOf(model, side, truth);
    LegAngles leg{};
    const Reach reach = legInverseKinematics(model, side, target, leg);
    expectWithinLimits(model, firstJoint(side, true), leg);
    const double closed = distance(soleOf(model, side, leg), target);
    EXPECT_EQ(reach == Reach::Exact, closed < 1e-9);
    if (reach != Reach::Limited) continue;
    ++limited;
    LegAngles polished = leg;
    const NumericSolution near = numericLegInverseKinematics(model, side, target, polished);
    EXPECT_NEAR(near.distance, distance(soleOf(model, side, polished), target), 1e-9);
    EXPECT_LT(closed, near.distance + 1e-6) << "trial " << trial;
    double best = std::numeric_limits<double>::infinity();
    for (int start = 0; start < 4; ++start) {
      LegAngles numeric = limbAngles<6>(firstJoint(side, true), randomAngles(model, random));
      best = std::min(best, numericLegInverseKinematics(model, side, target, numeric).distance);
    }
    if (closed > best + 1e-4) ++beaten;
  }
  EXPECT_GT(limited, 150);
  EXPECT_LE(beaten, limited / 50);
}

// Against the forward kinematics, in postures in which a kick's foot is.
TEST(LegInverseKinematics, TheShiftedSoleIsWhereItShouldBe) {
  Random random(8);
  std::vector<double> errors;  // as shares of the change
  for (int trial = 0; trial < 2000; ++trial) {
    const RobotModel& model = robotModel(trial % kRobotTypeCount);
    const Side side = trial % 2 == 0 ? Side::Left : Side::Right;
    LegAngles leg{random.uniform(-0.5, 0.0),  random.uniform(-0.2, 0.2), random.uniform(0.2, 1.2),
                  random.uniform(-1.8, -0.7), random.uniform(-0.5, 1.0), random.uniform(-0.3, 0.3)};
    const Pose3 before = soleOf(model, side, leg);
    Pose3 wanted = before;
    const Vector3 way(random.uniform(-0.05, 0.05), random.uniform(-0.04, 0.04), random.uniform(-0.01, 0.01));
    const double yaw = random.uniform(-0.2, 0.2);
    wanted.translation() += way;
    wanted.linear() = Eigen::AngleAxisd(yaw, Vector3::UnitZ()) * wanted.linear();
    shiftSole(model, side, way, yaw, leg);
    errors.push_back(distance(soleOf(model, side, leg), wanted) / distance(before, wanted));
    EXPECT_LT(errors.back(), 1.0) << "trial " << trial;
  }
  std::sort(errors.begin(), errors.end());
  EXPECT_LT(errors[errors.size() / 2], 0.01);
  EXPECT_LT(errors[errors.size() * 9 / 10], 0.1);
}

TEST(ArmInverseKinematics, ReachesRandomPlacesOfAllTypes) {
  Random random(31);
  for (int type = 0; type < kRobotTypeCount; ++type) {
    const RobotModel& model = robotModel(type);
    for (const Side side : {Side::Left, Side::Right}) {
      double worst = 0.0;
      int exact = 0;
      int moreBent = 0;
      for (int trial = 0; trial < kPosesPerLimb; ++trial) {
        const ArmAngles truth = limbAngles<4>(firstJoint(side, false), randomAngles(model, random));
        const Vector3 target = handOf(model, side, truth);
        ArmAngles found{};
        if (armInverseKinematics(model, side, target, found) == Reach::Exact) ++exact;
        worst = std::max(worst, (handOf(model, side, found) - target).norm());
        // The elbow is bent least: never more than in the pose that made the target.
        if (std::abs(found[3]) > std::abs(truth[3]) + 1e-7) ++moreBent;
      }
      EXPECT_EQ(exact, kPosesPerLimb) << "type " << type;
      EXPECT_EQ(moreBent, 0) << "type " << type;
      EXPECT_LT(worst, 1e-9) << "type " << type;
    }
  }
}

// Brute force over the one free parameter: no in-limit solution has the elbow bent less.
TEST(ArmInverseKinematics, ElbowIsBentLeast) {
  Random random(32);
  const RobotModel& model = robotModel(1);
  for (int trial = 0; trial < 30; ++trial) {
    const ArmAngles truth = limbAngles<4>(JointId::RArm1, randomAngles(model, random));
    const Vector3 target = handOf(model, Side::Right, truth);
    ArmAngles found{};
    ASSERT_EQ(armInverseKinematics(model, Side::Right, target, found), Reach::Exact);
    for (int start = 0; start < 40; ++start) {
      ArmAngles numeric = limbAngles<4>(JointId::RArm1, randomAngles(model, random));
      if (numericArmInverseKinematics(model, Side::Right, target, numeric).distance > 1e-9) continue;
      EXPECT_GE(std::abs(numeric[3]), std::abs(found[3]) - 1e-6);
    }
  }
}

TEST(ArmInverseKinematics, OutOfReachIsAsNearAsTheNumericSolver) {
  Random random(33);
  int limited = 0;
  int tooFar = 0;
  int beaten = 0;
  for (int trial = 0; trial < 500; ++trial) {
    const RobotModel& model = robotModel(trial % kRobotTypeCount);
    const Side side = trial % 2 == 0 ? Side::Left : Side::Right;
    Vector3 target(random.uniform(-0.3, 0.3), random.uniform(-0.4, 0.4), random.uniform(-0.2, 0.4));
    if (trial % 4 != 0) {
      // Most of them as far from the shoulder as the hand can be, so that the other limits matter.
      const Vector3 shoulder = model.body(side == Side::Left ? BodyId::LShoulder : BodyId::RShoulder).p_RB;
      const Vector3 stretched = handOf(model, side, ArmAngles{}) - shoulder;
      target = shoulder + (target - shoulder).normalized() * random.uniform(0.75, 1.0) * stretched.norm();
    }
    ArmAngles found{};
    const Reach reach = armInverseKinematics(model, side, target, found);
    expectWithinLimits(model, firstJoint(side, false), found);
    const double error = (handOf(model, side, found) - target).norm();
    EXPECT_EQ(reach == Reach::Exact, error < 1e-9) << error;
    if (reach == Reach::Exact) continue;
    ++(reach == Reach::Limited ? limited : tooFar);
    double best = std::numeric_limits<double>::infinity();
    for (int start = 0; start < 4; ++start) {
      ArmAngles numeric = limbAngles<4>(firstJoint(side, false), randomAngles(model, random));
      best = std::min(best, numericArmInverseKinematics(model, side, target, numeric).distance);
    }
    if (error > 1.03 * best + 1e-6) ++beaten;
  }
  EXPECT_GT(limited, 30);
  EXPECT_GT(tooFar, 30);
  EXPECT_LE(beaten, (limited + tooFar) / 50);
}

TEST(InverseKinematics, StrangeTargetsGiveFiniteAnglesWithinLimits) {
  const RobotModel& model = robotModel(0);
  const Vector3 hip = model.body(BodyId::LHip1).p_RB;
  const Vector3 shoulder = model.body(BodyId::LShoulder).p_RB;
  for (const Vector3& p : {hip, shoulder, Vector3(0, 0, 0), Vector3(100, -100, 100), Vector3(0, 0, 1e-12)}) {
    for (int turn = 0; turn < 8; ++turn) {
      Pose3 target(Eigen::Translation3d(p) *
                   Eigen::AngleAxisd(turn * kPi / 4, Vector3(1, 1, turn).normalized()));
      LegAngles leg{};
      EXPECT_NE(legInverseKinematics(model, Side::Left, target, leg), Reach::Exact);
      expectWithinLimits(model, JointId::LLeg1, leg);
      ArmAngles arm{};
      armInverseKinematics(model, Side::Left, p, arm);
      expectWithinLimits(model, JointId::LArm1, arm);
    }
  }
}

TEST(InverseKinematics, LegAnglesAreReadAndWrittenByPlace) {
  JointArray joints{};
  for (std::size_t i = 0; i < kJointCount; ++i) joints[i] = static_cast<double>(i);
  const LegAngles left = legAngles(Side::Left, joints);
  EXPECT_EQ(left[0], static_cast<double>(index(JointId::LLeg1)));
  EXPECT_EQ(left[5], static_cast<double>(index(JointId::LLeg6)));
  JointArray copy{};
  setLegAngles(Side::Left, left, copy);
  EXPECT_EQ(copy[index(JointId::LLeg6)], left[5]);
  EXPECT_EQ(copy[index(JointId::LLeg7)], 0.0);
}

}  // namespace
}  // namespace nonet::model
