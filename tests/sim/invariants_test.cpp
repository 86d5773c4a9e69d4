// Each invariant is broken on purpose, one at a time, and must be reported as what it is.
#include "nonet/sim/invariants.h"

#include <algorithm>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "nonet/math/angle.h"
#include "nonet/protocol/log_file.h"
#include "nonet/protocol/percept_text.h"

namespace nonet::sim {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class BrokenWorld : public ::testing::Test {
 protected:
  BrokenWorld() : robot_(simulation_.world().addRobot(0)) {}

  Invariants checked() {
    Invariants invariants;
    invariants.check(simulation_);
    return invariants;
  }
  World& world() { return simulation_.world(); }

  Simulation simulation_{Settings{}};
  RobotHandle robot_;
};

TEST_F(BrokenWorld, WholeWorldIsFine) {
  const Invariants invariants = checked();
  EXPECT_EQ(invariants.violations(), 0U);
  EXPECT_NEAR(invariants.extremes().lowestCentre, 0.042, 1e-6) << "the ball's";
}

TEST_F(BrokenWorld, NumbersThatAreNone) {
  World::BodyState state = world().bodyState(robot_, model::BodyId::Head);
  state.velocity.y() = std::numeric_limits<double>::quiet_NaN();
  world().setBodyState(robot_, model::BodyId::Head, state);
  EXPECT_THAT(checked().messages(), ElementsAre(HasSubstr("is not finite")));
}

TEST_F(BrokenWorld, RobotBelowGround) {
  World::BodyState state = world().bodyState(robot_, model::BodyId::LFoot);
  state.position.z() = -0.2;
  world().setBodyState(robot_, model::BodyId::LFoot, state);
  EXPECT_THAT(checked().messages(), ElementsAre(HasSubstr("-0.200 m above the ground")));
}

TEST_F(BrokenWorld, RobotThatExplodes) {
  World::BodyState state = world().bodyState(robot_, model::BodyId::Torso);
  state.velocity.x() = 1000.0;
  world().setBodyState(robot_, model::BodyId::Torso, state);
  EXPECT_THAT(checked().messages(), ElementsAre(HasSubstr("1000.0 m/s")));
}

TEST_F(BrokenWorld, JointFarBeyondItsStop) {
  World::BodyState state = world().bodyState(robot_, model::BodyId::Head);
  state.orientation = Eigen::AngleAxisd(1.2, Eigen::Vector3d::UnitX());  // pitch, stops at 45 degrees
  world().setBodyState(robot_, model::BodyId::Head, state);
  const Invariants invariants = checked();
  EXPECT_THAT(invariants.messages(), ElementsAre(HasSubstr("hj2")));
  EXPECT_NEAR(invariants.extremes().overshoot, 1.2 - 0.7854, 1e-3);
}

TEST_F(BrokenWorld, AToeHasABoundOfItsOwn) {
  robot_ = world().addRobot(4);
  World::BodyState state = world().bodyState(robot_, model::BodyId::RToe);
  state.orientation = Eigen::AngleAxisd(-1.0, Eigen::Vector3d::UnitX()) * state.orientation;
  world().setBodyState(robot_, model::BodyId::RToe, state);
  EXPECT_THAT(checked().messages(), ElementsAre(HasSubstr("rlj7")));
  for (const bool wide : {false, true}) {
    InvariantLimits limits;
    (wide ? limits.toeOvershoot : limits.overshoot) = 1.1;
    Invariants invariants(limits);
    invariants.check(simulation_);
    EXPECT_EQ(invariants.violations(), wide ? 0U : 1U);
  }
}

TEST(Invariants, LetAJointOvershootAsFarAsTheRealServersDo) {
  protocol::LogReader reader(NONET_TEST_DATA "/sim/overshoot_type3.log.gz");
  double farthest = 0.0;
  protocol::Percept percept;
  for (protocol::LogLine line; reader.next(line);) {
    if (line.kind != protocol::LogLine::Kind::Received) continue;
    protocol::parsePercept(line.text, percept);
    for (const model::JointSpec& joint : model::robotModel(3).joints()) {
      const double angle = percept.joints[model::index(joint.id)];
      farthest = std::max({farthest, joint.low - angle, angle - joint.high});
    }
  }
  EXPECT_NEAR(toDegrees(farthest), toDegrees(InvariantLimits{}.overshoot), 0.01);
}

TEST_F(BrokenWorld, CommandThatIsNoNumberReachesNoJoint) {
  world().setJointSpeed(robot_, model::JointId::Head1, 1.0F);
  world().setJointSpeed(robot_, model::JointId::Head1, std::numeric_limits<float>::quiet_NaN());
  const float before = world().jointAngle(robot_, model::JointId::Head1);
  world().prePhysics();
  world().stepPhysics();
  EXPECT_NEAR(world().jointAngle(robot_, model::JointId::Head1) - before, 0.02, 1e-3) << "the old speed";
  EXPECT_EQ(checked().violations(), 0U);
}

}  // namespace
}  // namespace nonet::sim
