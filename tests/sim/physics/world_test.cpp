#include "nonet/sim/physics/world.h"

#include <algorithm>
#include <cmath>
#include <thread>

#include <gtest/gtest.h>

#include "nonet/math/angle.h"
#include "nonet/math/random.h"
#include "nonet/sim/fidelity/fixed_episode.h"

namespace nonet::sim {
namespace {

using model::BodyId;
using model::JointId;

constexpr double kStep = 0.02F;  // as the server passes it to ODE

void step(World& world, int cycles = 1) {
  for (int i = 0; i < cycles; ++i) {
    world.prePhysics();
    world.stepPhysics();
  }
}

/// Drives every robot with speeds that depend on cycle and handle only.
void drive(World& world, int cycle) {
  for (const RobotHandle robot : world.robots()) {
    Random random(static_cast<std::uint64_t>(cycle / 10 * 100 + robot));
    for (const model::JointSpec& joint : model::robotModel(world.robotType(robot)).joints()) {
      world.setJointSpeed(robot, joint.id, static_cast<float>(random.uniform(-3.0, 3.0)));
    }
  }
}

void driveAndStep(World& world, int from, int cycles) {
  for (int i = from; i < from + cycles; ++i) {
    drive(world, i);
    step(world);
  }
}

/// Three robots of three types, two of which fall onto each other, and a ball that rolls between them.
void buildCrowd(World& world) {
  const RobotHandle first = world.addRobot(0);
  world.placeRobot(first, {-1.0F, 0.0F, 0.4F}, -90.0F);
  const RobotHandle second = world.addRobot(4);
  world.placeRobot(second, {-0.75F, 0.05F, 0.45F}, 90.0F);
  const RobotHandle third = world.addRobot(3);
  world.placeRobot(third, {2.0F, 1.0F, 0.45F}, 30.0F);
  world.setBallPosition({-3.0F, 0.05F, 0.05F});
  world.setBallVelocity({4.0F, 0.0F, 0.5F});
}

class WorldOfSolver : public testing::TestWithParam<WorldSettings::Solver> {};

INSTANTIATE_TEST_SUITE_P(Solvers, WorldOfSolver,
                         testing::Values(WorldSettings::Solver::Exact, WorldSettings::Solver::Quick),
                         [](const auto& info) {
                           return info.param == WorldSettings::Solver::Exact ? "Exact" : "Quick";
                         });

TEST_P(WorldOfSolver, SameCommandsGiveTheSameBits) {
  World one(WorldSettings{.solver = GetParam()});
  World two(WorldSettings{.solver = GetParam()});
  buildCrowd(one);
  buildCrowd(two);
  for (int i = 0; i < 100; ++i) {
    driveAndStep(one, i, 1);
    driveAndStep(two, i, 1);
    ASSERT_EQ(one.signature(), two.signature()) << "cycle " << i;
  }
}

TEST(World, WorldsInSeveralThreadsDoNotDisturbEachOther) {
  World alone;
  buildCrowd(alone);
  driveAndStep(alone, 0, 80);
  std::array<std::uint64_t, 4> signatures{};
  std::vector<std::thread> threads;
  for (auto& signature : signatures) {
    threads.emplace_back([&signature] {
      World world;
      buildCrowd(world);
      driveAndStep(world, 0, 80);
      signature = world.signature();
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const auto signature : signatures) EXPECT_EQ(signature, alone.signature());
}

// Robots apart from each other are stepped by several threads, those that touch together: nobody can tell.
TEST_P(WorldOfSolver, TheNumberOfThreadsDoesNotMatter) {
  World one(WorldSettings{.solver = GetParam()});
  World three(WorldSettings{.solver = GetParam(), .threads = 3});
  for (World* world : {&one, &three}) {
    buildCrowd(*world);
    for (int i = 0; i < 5; ++i) {
      const RobotHandle robot = world->addRobot(i);
      world->placeRobot(robot, {static_cast<float>(i) - 2.0F, -1.5F, 0.45F}, 40.0F * static_cast<float>(i));
    }
  }
  for (int i = 0; i < 100; ++i) {
    driveAndStep(one, i, 1);
    driveAndStep(three, i, 1);
    ASSERT_EQ(one.signature(), three.signature()) << "cycle " << i;
  }
  EXPECT_EQ(one.save(), three.save());
}

TEST(World, NumbersThatAreNotFiniteAreIgnored) {
  World world;
  const RobotHandle robot = world.addRobot(0);
  step(world, 2);
  const std::uint64_t before = world.signature();
  const float nan = std::nanf("");
  world.placeRobot(robot, {0.0F, nan, 0.4F}, 0.0F);
  world.placeRobot(robot, {0.0F, 0.0F, 0.4F}, nan);
  world.moveRobot(robot, {0.0F, 0.0F, HUGE_VALF});
  world.setBallPosition({nan, 0.0F, 0.0F});
  world.setBallVelocity({0.0F, -HUGE_VALF, 0.0F});
  EXPECT_EQ(world.signature(), before);
  world.setJointSpeed(robot, JointId::LLeg3, nan);
  step(world, 10);
  EXPECT_TRUE(world.bodyPose(robot, BodyId::Torso).position.allFinite());
}

// Kept in the repository: a change that has no effect on the physics and the sensors keeps this number, a
// change that has one must say so and bring the new one (`nonet bench` prints it).
TEST(World, TheFixedEpisodeKeepsItsSignature) {
  constexpr std::uint64_t kSignature = 0xa403c0c844f7468eULL;
  for (const int threads : {1, 3}) {
    EXPECT_EQ(runFixedEpisode(WorldSettings{.threads = threads}, 5, 150, true).signature, kSignature);
  }
}

// From the same state both steppers must find the same velocities: the solution of the equations is unique.
TEST(World, BothSolversAgreeInEachStep) {
  World exact;
  World quick(WorldSettings{.solver = WorldSettings::Solver::Quick});
  buildCrowd(exact);
  double worst = 0.0;
  for (int i = 0; i < 200; ++i) {
    drive(exact, i);
    quick.restore(exact.save());
    step(exact);
    step(quick);
    ASSERT_EQ(exact.contacts().size(), quick.contacts().size());
    for (const RobotHandle robot : exact.robots()) {
      for (const model::BodySpec& body : model::robotModel(exact.robotType(robot)).bodies()) {
        const World::BodyState a = exact.bodyState(robot, body.id);
        const World::BodyState b = quick.bodyState(robot, body.id);
        worst = std::max(worst, (a.velocity - b.velocity).norm());
        worst = std::max(worst, 0.1 * (a.angularVelocity - b.angularVelocity).norm());
        ASSERT_LT((a.position - b.position).norm(), 1e-8) << "cycle " << i;
      }
      for (const BodyId foot : {BodyId::RFoot, BodyId::LFoot}) {
        const auto a = exact.footContact(robot, foot);
        const auto b = quick.footContact(robot, foot);
        ASSERT_EQ(a.has_value(), b.has_value());
        if (a) {
          ASSERT_LT((a->force - b->force).norm(), 1e-2F) << "cycle " << i;
        }
      }
    }
  }
  EXPECT_LT(worst, 1e-6);
}

class WorldSnapshot : public testing::TestWithParam<std::tuple<int, WorldSettings::Solver>> {};

TEST_P(WorldSnapshot, ContinuesBitByBit) {
  const auto [savedAt, solver] = GetParam();
  World original(WorldSettings{.solver = solver});
  buildCrowd(original);
  driveAndStep(original, 0, savedAt);
  const std::vector<std::uint8_t> state = original.save();
  // Into a world that has a history of its own.
  World copy(WorldSettings{.solver = solver});
  buildCrowd(copy);
  copy.removeRobot(copy.robots().front());
  driveAndStep(copy, 7, 11);
  copy.restore(state);
  EXPECT_EQ(copy.save(), state);
  EXPECT_EQ(copy.time(), original.time());
  for (int i = savedAt; i < savedAt + 80; ++i) {
    driveAndStep(original, i, 1);
    driveAndStep(copy, i, 1);
    ASSERT_EQ(original.signature(), copy.signature()) << "cycle " << i;
    ASSERT_EQ(original.contacts().size(), copy.contacts().size());
  }
  EXPECT_EQ(copy.save(), original.save());
}

INSTANTIATE_TEST_SUITE_P(At, WorldSnapshot,
                         testing::Combine(testing::Values(0, 1, 40, 100),
                                          testing::Values(WorldSettings::Solver::Exact,
                                                          WorldSettings::Solver::Quick)));

// Robots asleep, one of them moved while asleep, one woken: what ODE keeps to itself must come along.
TEST(World, SnapshotKeepsSleepAndMoves) {
  World original;
  std::vector<RobotHandle> robots;
  for (int i = 0; i < 3; ++i) {
    robots.push_back(original.addRobot(i));
    original.placeRobot(robots.back(), {static_cast<float>(2 * i), 1.0F, i == 1 ? 0.44F : 0.4F}, 0.0F);
    step(original, 2);
  }
  step(original, 100);
  for (const RobotHandle robot : robots) ASSERT_TRUE(original.isAsleep(robot));
  original.moveRobot(robots[1], {2.0F, 3.0F, 0.6F});
  original.setJointSpeed(robots[2], JointId::Head1, 0.5F);
  World copy;
  copy.restore(original.save());
  for (const RobotHandle robot : robots) {
    EXPECT_EQ(copy.isAsleep(robot), original.isAsleep(robot));
    EXPECT_EQ(copy.footContact(robot, BodyId::RFoot).has_value(),
              original.footContact(robot, BodyId::RFoot).has_value());
  }
  for (int i = 0; i < 60; ++i) {
    if (i == 20) {
      original.setJointSpeed(robots[1], JointId::Head1, 0.5F);
      copy.setJointSpeed(robots[1], JointId::Head1, 0.5F);
    }
    step(original);
    step(copy);
    ASSERT_EQ(original.signature(), copy.signature()) << "cycle " << i;
    for (const RobotHandle robot : robots) ASSERT_EQ(copy.isAsleep(robot), original.isAsleep(robot));
  }
}

TEST(World, DamagedSnapshotsAreRefused) {
  World world;
  world.addRobot(0);
  std::vector<std::uint8_t> state = world.save();
  state.pop_back();
  EXPECT_THROW(world.restore(state), std::runtime_error);
  state[0] ^= 1U;
  EXPECT_THROW(world.restore(state), std::runtime_error);
}

// What is not a count or a name, such as the place of a contact, may be anything.
TEST(World, SnapshotsWithWrongCountsOrNamesAreRefused) {
  World world;
  buildCrowd(world);
  step(world, 40);
  const std::vector<std::uint8_t> good = world.save();
  World other;
  constexpr std::size_t kTail = 100;  // the members and the last contacts
  ASSERT_GT(good.size(), kTail);
  int refused = 0;
  for (std::size_t i = good.size() - kTail; i < good.size(); ++i) {
    std::vector<std::uint8_t> state = good;
    state[i] = 0xff;
    try {
      other.restore(state);
    } catch (const std::runtime_error&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 20);
  other.restore(good);
  EXPECT_EQ(other.save(), good);
}

TEST(World, SnapshotsWithAGeomTwiceAreRefused) {
  World world;
  world.addRobot(0);
  std::vector<std::uint8_t> state = world.save();
  // The members of the space end the state, 32-bit numbers each.
  const auto last = state.end() - 4;
  std::copy_n(last - 4, 4, last);
  EXPECT_THROW(world.restore(state), std::runtime_error);
}

// Semi-implicit Euler with linear drag: v' = v + h (-g - c v / m), x' = x + h v'.
TEST(World, FreeBallFollowsTheClosedForm) {
  World world;
  world.setBallPosition({1.0F, 2.0F, 10.0F});
  world.setBallVelocity({3.0F, -2.0F, 5.0F});
  Eigen::Vector3d x(1.0, 2.0, 10.0);
  Eigen::Vector3d v(3.0, -2.0, 5.0);
  for (int i = 0; i < 60; ++i) {
    step(world);
    v += kStep * (Eigen::Vector3d(0, 0, -9.81) - 0.01 / 0.026 * v);
    x += kStep * v;
    ASSERT_LT((world.ballPosition().cast<double>() - x).norm(), 2e-5) << "cycle " << i;
    ASSERT_LT((world.ballVelocity().cast<double>() - v).norm(), 2e-5);
  }
}

// Server facts 2.4: a free joint moves at the commanded speed from the first step on; speeds are cut.
TEST(World, JointsMoveAtTheCommandedSpeed) {
  for (const float speed : {1.0F, -2.5F, 20.0F}) {
    World world;
    const RobotHandle robot = world.addRobot(0);
    world.setJointSpeed(robot, JointId::LArm1, speed);
    step(world, 5);
    const double effective =
        std::min(6.13955, static_cast<double>(std::abs(speed))) * std::copysign(1.0, speed);
    EXPECT_NEAR(world.jointAngle(robot, JointId::LArm1), 5 * kStep * effective, 1e-3);
  }
}

TEST(World, TypeTwoHasItsOwnAnkleSpeeds) {
  World world;
  const RobotHandle robot = world.addRobot(2);
  world.setJointSpeed(robot, JointId::RLeg5, 20.0F);
  world.setJointSpeed(robot, JointId::RLeg6, 20.0F);
  step(world, 3);
  EXPECT_NEAR(world.jointAngle(robot, JointId::RLeg5), 3 * kStep * 8.80667, 2e-3);
  EXPECT_NEAR(world.jointAngle(robot, JointId::RLeg6), 3 * kStep * 3.47234, 2e-3);
}

TEST(World, BeyondAStopCommandsAreIgnored) {
  World world;
  const RobotHandle robot = world.addRobot(0);
  const double stop = toRadians(45.0);
  bool beyond = false;
  for (int i = 0; i < 60 && !beyond; ++i) {
    world.setJointSpeed(robot, JointId::Head2, 6.1F);
    step(world);
    beyond = world.jointAngle(robot, JointId::Head2) > stop;
  }
  ASSERT_TRUE(beyond);
  World obedient;
  obedient.restore(world.save());
  world.setJointSpeed(robot, JointId::Head2, -1.0F);  // ignored: the joint is thrown back at full speed
  step(world);
  step(obedient);
  EXPECT_EQ(world.signature(), obedient.signature());
}

TEST(World, FrozenJointsTakeEveryCommandAsZero) {
  World world;
  const RobotHandle robot = world.addRobot(0);
  world.freezeJoint(robot, JointId::RArm1, true);
  EXPECT_TRUE(world.isFrozen(robot, JointId::RArm1));
  world.setJointSpeed(robot, JointId::RArm1, 3.0F);
  step(world, 5);
  EXPECT_NEAR(world.jointAngle(robot, JointId::RArm1), 0.0, 1e-3);
  world.freezeJoint(robot, JointId::RArm1, false);
  world.setJointSpeed(robot, JointId::RArm1, 3.0F);
  step(world, 5);
  EXPECT_NEAR(world.jointAngle(robot, JointId::RArm1), 0.3, 1e-3);
}

// Server facts 3.4 and 7.1, quirk 16.
TEST(World, SleepingRobotHoversWhenItIsMoved) {
  World world;
  const RobotHandle robot = world.addRobot(0);
  world.placeRobot(robot, {0.0F, 0.0F, 0.4F}, 0.0F);
  step(world, 100);
  EXPECT_TRUE(world.isAsleep(robot));
  EXPECT_NEAR(world.bodyPose(robot, BodyId::Torso).position.z(), 0.38387, 5e-5);
  EXPECT_NEAR(world.footContact(robot, BodyId::LFoot)->force.z(), 22.59, 0.5);
  world.moveRobot(robot, {3.0F, 1.0F, 0.4F});
  step(world, 50);
  EXPECT_FLOAT_EQ(world.bodyPose(robot, BodyId::Torso).position.z(), 0.4F);
  EXPECT_NEAR(world.accelerometer(robot).z(), 9.81, 1e-5);
  EXPECT_FALSE(world.footContact(robot, BodyId::LFoot));
  world.setJointSpeed(robot, JointId::Head1, 0.01F);
  step(world, 2);
  EXPECT_LT(world.bodyPose(robot, BodyId::Torso).position.z(), 0.4F);
}

// As an agent does that beams in every cycle before kick-off and moves no joint.
TEST(World, ASleepingRobotMayBePlacedAgainAndAgain) {
  World world;
  const RobotHandle robot = world.addRobot(0);
  for (int i = 0; i < 1000; ++i) {
    if (i == 150) {
      ASSERT_TRUE(world.isAsleep(robot));
    }
    if (i == 0 || i >= 150) world.placeRobot(robot, {0.0F, 0.0F, 0.385F}, i % 2 == 0 ? 90.0F : 33.0F);
    step(world);
  }
  const Eigen::Matrix3f& rotation = world.bodyPose(robot, BodyId::LFoot).rotation;
  EXPECT_NEAR((rotation.transpose() * rotation - Eigen::Matrix3f::Identity()).norm(), 0.0F, 1e-4F);
  EXPECT_NEAR(rotation(2, 2), 1.0F, 0.01F) << "the foot is still flat";
}

// Server facts 2.6: the accelerometer shows the change of velocity of the step before the newest one.
TEST(World, AccelerometerIsOneCycleOld) {
  World world;
  const RobotHandle robot = world.addRobot(0);
  step(world, 3);
  EXPECT_NEAR(world.accelerometer(robot).z(), 0.0, 0.02);  // falling, with a little drag
  world.placeRobot(robot, {0.0F, 0.0F, 2.0F}, 0.0F);
  const float speed = world.bodyVelocity(robot, BodyId::Torso).z();
  EXPECT_EQ(speed, 0.0F);
  step(world);
  EXPECT_GT(world.accelerometer(robot).z(), 20.0F);  // the velocity was taken away
  step(world);
  EXPECT_NEAR(world.accelerometer(robot).z(), 0.0, 0.02);
}

TEST(World, DeferredPlacementPutsTheTorsoExactly) {
  World world;
  const RobotHandle robot = world.addRobot(1);
  step(world, 3);
  world.deferPlacement(robot, World::DeferredBy::Beam, {-5.0F, 2.0F, 3.0F}, -90.0F);
  world.prePhysics();
  const World::BodyState torso = world.bodyState(robot, BodyId::Torso);
  EXPECT_LT((torso.position - Eigen::Vector3d(-5, 2, 3)).norm(), 1e-6);
  EXPECT_LT((torso.orientation * Eigen::Vector3d::UnitY() - Eigen::Vector3d::UnitX()).norm(), 1e-6);
  EXPECT_EQ(torso.velocity.norm(), 0.0);
  world.stepPhysics();
  step(world);
  EXPECT_NEAR(world.bodyPose(robot, BodyId::Torso).position.x(), -5.0, 1e-3);  // not placed again
}

TEST(World, BodyStatesGoInAndOut) {
  World world;
  const RobotHandle robot = world.addRobot(0);
  World::BodyState state;
  state.position = {1.0, 2.0, 3.0};
  state.orientation = Eigen::Quaterniond(0.5, -0.5, 0.5, 0.5);
  state.velocity = {0.1, 0.2, 0.3};
  state.angularVelocity = {-1.0, 2.0, 3.0};
  world.setBodyState(robot, BodyId::Head, state);
  const World::BodyState back = world.bodyState(robot, BodyId::Head);
  EXPECT_EQ(back.position, state.position);
  EXPECT_EQ(back.orientation.coeffs(), state.orientation.coeffs());
  EXPECT_EQ(back.velocity, state.velocity);
  EXPECT_EQ(back.angularVelocity, state.angularVelocity);
}

TEST(World, HandlesAreNotUsedAgain) {
  World world;
  const RobotHandle first = world.addRobot(0);
  world.removeRobot(first);
  const RobotHandle second = world.addRobot(0);
  EXPECT_NE(first, second);
  EXPECT_THROW(world.jointAngle(first, JointId::Head1), std::out_of_range);
  ASSERT_EQ(world.robots().size(), 1U);
  EXPECT_EQ(world.robots()[0], second);
}

TEST(World, BallInEachGoalIsNoticed) {
  for (const float side : {-1.0F, 1.0F}) {
    World world;
    world.setBallPosition({side * 14.9F, 0.3F, 0.042F});
    step(world);
    EXPECT_EQ(world.ballInGoal(), World::Goal::None);
    world.setBallPosition({side * 15.05F, 0.3F, 0.042F});
    step(world);
    EXPECT_EQ(world.ballInGoal(), side < 0.0F ? World::Goal::Left : World::Goal::Right);
  }
}

TEST(World, ContactsNameTheirParties) {
  World world;
  const RobotHandle robot = world.addRobot(0);
  world.placeRobot(robot, {0.0F, 0.0F, 0.4F}, 0.0F);
  world.setBallPosition({0.055F, 0.12F, 0.05F});  // touches the front of the right foot
  bool footOnGround = false;
  bool footOnBall = false;
  for (int i = 0; i < 10; ++i) {
    step(world);
    for (const ContactPair& pair : world.contacts()) {
      const bool foot = pair.first.body == BodyId::RFoot || pair.second.body == BodyId::RFoot;
      const auto has = [&pair](ContactParty::Kind kind) {
        return pair.first.kind == kind || pair.second.kind == kind;
      };
      EXPECT_GE(pair.pointCount, 1);
      EXPECT_LE(pair.pointCount, 4);
      if (!has(ContactParty::Kind::Robot) || !foot) continue;
      footOnGround = footOnGround || has(ContactParty::Kind::Static);
      footOnBall = footOnBall || has(ContactParty::Kind::Ball);
    }
  }
  EXPECT_TRUE(footOnGround);
  EXPECT_TRUE(footOnBall);
}

// Invariants over a rough episode: everything finite, no joint far beyond its stops, nobody under ground.
TEST(World, RoughTreatmentDoesNotBreakARobot) {
  World world;
  buildCrowd(world);
  for (int i = 0; i < 300; ++i) {
    driveAndStep(world, i, 1);
    for (const RobotHandle robot : world.robots()) {
      for (const model::BodySpec& body : model::robotModel(world.robotType(robot)).bodies()) {
        const Vector3f position = world.bodyPose(robot, body.id).position;
        ASSERT_TRUE(position.allFinite());
        ASSERT_GT(position.z(), -0.1F);
      }
      for (const model::JointSpec& joint : model::robotModel(world.robotType(robot)).joints()) {
        const double angle = world.jointAngle(robot, joint.id);
        ASSERT_GT(angle, joint.low - toRadians(15.0));
        ASSERT_LT(angle, joint.high + toRadians(15.0));
      }
    }
  }
}

}  // namespace
}  // namespace nonet::sim
