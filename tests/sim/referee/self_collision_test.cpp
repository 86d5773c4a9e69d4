// Self-collision: server facts 4.10, one scenario per rule.
#include "nonet/sim/referee/self_collision.h"

#include <filesystem>
#include <fstream>
#include <string>
#include <utility>

#include <gtest/gtest.h>
#include <unistd.h>

#include "sim/scenario.h"

namespace nonet::sim::test {
namespace {

// Legs that turn into each other until boxes overlap deeply and tilted: nothing else is found (server
// facts 4.10).
void crossLegs(Scenario& s, AgentHandle agent) {
  protocol::Effectors effectors;
  for (const auto& [joint, speed] :
       {std::pair{model::JointId::RLeg1, -2.0}, std::pair{model::JointId::RLeg2, 2.0},
        std::pair{model::JointId::RLeg3, -2.0}, std::pair{model::JointId::RLeg4, 2.0},
        std::pair{model::JointId::RLeg5, 2.0}, std::pair{model::JointId::RLeg6, -1.0},
        std::pair{model::JointId::LLeg1, -3.0}, std::pair{model::JointId::LLeg2, -1.0},
        std::pair{model::JointId::LLeg3, -2.0}, std::pair{model::JointId::LLeg4, -2.0}}) {
    effectors.setSpeed(joint, speed);
  }
  for (int i = 0; i < 30 && s.countFouls(FoulType::SelfCollision) == 0; ++i) {
    s.sim.act(agent, effectors);
    s.step();
  }
}

struct SelfCollision : Field {
  explicit SelfCollision(const Settings& settings = quietSettings()) : Field(settings) {
    player = add(TeamSide::Left, 2);
    place(player, -5.0, 2.0);
    play();
  }
  bool frozen(model::JointId joint) const { return sim.world().isFrozen(info(player).robot, joint); }
  AgentHandle player;
};

TEST(SelfCollision, LegsThatOverlapAreFrozenForASecond) {
  SelfCollision s;
  crossLegs(s, s.player);
  ASSERT_EQ(s.countFouls(FoulType::SelfCollision), 1);
  EXPECT_TRUE(s.frozen(model::JointId::RLeg1) && s.frozen(model::JointId::RLeg6));
  EXPECT_TRUE(s.frozen(model::JointId::LLeg1) && s.frozen(model::JointId::LLeg6));
  EXPECT_FALSE(s.frozen(model::JointId::Head1) || s.frozen(model::JointId::RArm1));
  s.seconds(0.96);
  EXPECT_TRUE(s.frozen(model::JointId::RLeg1));
  s.seconds(0.08);
  EXPECT_FALSE(s.frozen(model::JointId::RLeg1));
  s.seconds(1.5);
  EXPECT_EQ(s.countFouls(FoulType::SelfCollision), 1) << "cannot be frozen again for two seconds";
}

TEST(SelfCollision, IsFoundByItselfToo) {
  SelfCollision s;
  EXPECT_FALSE(selfCollides(s.sim.world(), s.info(s.player).robot));
  crossLegs(s, s.player);
  EXPECT_TRUE(selfCollides(s.sim.world(), s.info(s.player).robot));
}

TEST(SelfCollision, FrozenJointsTakeEveryCommandAsZero) {
  SelfCollision s;
  crossLegs(s, s.player);
  ASSERT_EQ(s.countFouls(FoulType::SelfCollision), 1);
  protocol::Effectors move;
  move.setSpeed(model::JointId::RLeg5, 2.0);
  move.setSpeed(model::JointId::Head1, 2.0);
  s.sim.act(s.player, move);
  s.step(2);
  const RobotHandle robot = s.info(s.player).robot;
  const float ankle = s.sim.world().jointAngle(robot, model::JointId::RLeg5);
  const float head = s.sim.world().jointAngle(robot, model::JointId::Head1);
  s.step(5);
  EXPECT_NEAR(s.sim.world().jointAngle(robot, model::JointId::RLeg5), ankle, 0.02);
  EXPECT_GT(s.sim.world().jointAngle(robot, model::JointId::Head1), head + 0.1F);
}

TEST(SelfCollision, JointsAreReleasedWhenTheGameIsPaused) {
  SelfCollision s;
  crossLegs(s, s.player);
  ASSERT_TRUE(s.frozen(model::JointId::RLeg1));
  s.setMode(PlayMode::GoalLeft);
  s.step();
  EXPECT_FALSE(s.frozen(model::JointId::RLeg1));
}

TEST(SelfCollision, JointsAreReleasedAtHalfTimeThoughSidesChange) {
  Settings settings = shortHalves(1000.0);
  settings.changeSidesInSecondHalf = true;
  SelfCollision s(settings);
  crossLegs(s, s.player);
  ASSERT_TRUE(s.frozen(model::JointId::RLeg1));
  s.command("(time 999.99)");
  for (int i = 0; i < 3; ++i) s.step();
  ASSERT_EQ(s.mode(), PlayMode::BeforeKickOff);
  ASSERT_EQ(s.info(s.player).side, TeamSide::Right);
  EXPECT_FALSE(s.frozen(model::JointId::RLeg1));
}

TEST(SelfCollision, CanBePunishedByRemovalInstead) {
  Settings settings = quietSettings();
  settings.selfCollisionBeamPenalty = true;
  SelfCollision s(settings);
  crossLegs(s, s.player);
  EXPECT_GT(s.countFouls(FoulType::SelfCollision), 0);
  EXPECT_FALSE(s.frozen(model::JointId::RLeg1));
  s.seconds(0.7);
  EXPECT_NEAR(s.torso(s.player).y(), -10.5, 0.1);
}

TEST(SelfCollision, ZeroPoseHasNone) {
  for (int type = 0; type < 5; ++type) {
    Field f;
    const AgentHandle player = f.add(TeamSide::Left, 2, type);
    f.place(player, -5.0, 2.0, 0.0, 0.45);
    f.play();
    f.seconds(0.5);
    EXPECT_EQ(f.countFouls(FoulType::SelfCollision), 0) << type;
  }
}

// Two legs side by side overlap, but their edges are nearly parallel: the server's test misses that.
TEST(SelfCollision, NearlyParallelBoxesAreMissed) {
  Scenario s;
  const AgentHandle player = s.add(TeamSide::Left, 2);
  s.place(player, -5.0, 2.0, 0.0, 1.0);
  s.setMode(PlayMode::PlayOn);
  protocol::Effectors inwards;
  inwards.setSpeed(model::JointId::RLeg2, 2.0);
  inwards.setSpeed(model::JointId::LLeg2, -2.0);
  double gap = 1.0;
  for (int i = 0; i < 12; ++i) {
    s.sim.act(player, inwards);
    s.step();
    const RobotHandle robot = s.info(player).robot;
    gap = (s.sim.world().bodyPosition(robot, model::BodyId::RShank) -
           s.sim.world().bodyPosition(robot, model::BodyId::LShank))
              .norm();
  }
  EXPECT_LT(gap, 0.06) << "the shanks are 0.08 m wide";
  EXPECT_EQ(s.countFouls(FoulType::SelfCollision), 0);
}

// Freezing turns later commands into zero; without one a joint goes on as before.
TEST(SelfCollision, AFrozenJointWithoutCommandGoesOn) {
  Scenario s;
  const AgentHandle player = s.add(TeamSide::Left, 2);
  s.place(player, -5.0, 2.0, 0.0, 1.0);
  s.setMode(PlayMode::PlayOn);
  const RobotHandle robot = s.info(player).robot;
  World& world = s.sim.world();
  world.setJointSpeed(robot, model::JointId::Head1, 1.0F);
  world.freezeJoint(robot, model::JointId::Head1, true);
  const float before = world.jointAngle(robot, model::JointId::Head1);
  s.step(5);
  EXPECT_NEAR(world.jointAngle(robot, model::JointId::Head1) - before, 0.1, 0.01);
  protocol::Effectors command;
  command.setSpeed(model::JointId::Head1, 1.0);
  s.sim.act(player, command);
  s.step();
  const float frozen = world.jointAngle(robot, model::JointId::Head1);
  s.step(5);
  EXPECT_NEAR(world.jointAngle(robot, model::JointId::Head1), frozen, 0.005);
}

TEST(SelfCollision, WithoutFoulsForItNothingIsFrozen) {
  Settings settings = quietSettings();
  settings.foulOnSelfCollisions = false;
  SelfCollision s(settings);
  crossLegs(s, s.player);
  EXPECT_EQ(s.countFouls(FoulType::SelfCollision), 0);
  EXPECT_FALSE(s.frozen(model::JointId::RLeg1));
}

TEST(SelfCollision, ARemovalIsNotRepeatedForTenSeconds) {
  Settings settings = quietSettings();
  settings.selfCollisionBeamPenalty = true;
  settings.foulHoldTime = 0.0;
  SelfCollision s(settings);
  crossLegs(s, s.player);
  ASSERT_EQ(s.countFouls(FoulType::SelfCollision), 1);
  protocol::Effectors stop;
  for (std::size_t i = 0; i < model::kJointCount; ++i) stop.setSpeed(model::jointAt(i), 0.0);
  s.sim.act(s.player, stop);
  s.seconds(9.8);
  EXPECT_EQ(s.countFouls(FoulType::SelfCollision), 1) << "the legs are still crossed";
  s.seconds(0.4);
  EXPECT_EQ(s.countFouls(FoulType::SelfCollision), 2);
}

TEST(SelfCollision, IsWrittenToAFileWhenWanted) {
  Settings settings = quietSettings();
  settings.writeSelfCollisionsToFile = true;
  const std::string file = testing::TempDir() + "self_collisions_" + std::to_string(::getpid()) + ".txt";
  std::filesystem::remove(file);
  settings.selfCollisionRecordFilename = file;
  SelfCollision s(settings);
  crossLegs(s, s.player);
  std::ifstream in(file);
  std::string first;
  std::string all;
  for (std::string line; std::getline(in, line); all += line + "\n") {
    if (first.empty()) first = line;
  }
  EXPECT_EQ(first.rfind("Collision GTime ", 0), 0U) << first;
  EXPECT_NE(all.find("Foul Team L Pl 2"), std::string::npos) << all;
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace nonet::sim::test
