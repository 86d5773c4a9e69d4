// Trainer commands: server facts 5.5, one test per row of the table.
#include "nonet/sim/referee/trainer.h"

#include <vector>

#include <gtest/gtest.h>

#include "sim/scenario.h"

namespace nonet::sim::test {
namespace {

struct Trained : Scenario {
  Trained() {
    left = add(TeamSide::Left, 2);
    right = add(TeamSide::Right, 3);
    place(left, -5.0, 1.0);
    place(right, 5.0, 1.0);
    step();
    setMode(PlayMode::PlayOn);
  }
  AgentHandle left, right;
};

TEST(TrainerCommand, PlayModeTakesEveryName) {
  Trained t;
  for (int mode = 0; mode < protocol::kPlayModeCount; ++mode) {
    t.setMode(static_cast<PlayMode>(mode));
    EXPECT_EQ(t.mode(), static_cast<PlayMode>(mode));
  }
  t.command("(playMode playon)");
  EXPECT_EQ(t.mode(), PlayMode::PassRight) << "names are case-sensitive, unknown ones ignored";
}

TEST(TrainerCommand, KickOff) {
  Trained t;
  t.command("(kickOff Right)");
  EXPECT_EQ(t.mode(), PlayMode::KickOffRight);
  t.command("(kickOff Left)");
  EXPECT_EQ(t.mode(), PlayMode::KickOffLeft);
  t.setMode(PlayMode::PlayOn);
  t.command("(kickOff left)");
  EXPECT_EQ(t.mode(), PlayMode::PlayOn);
}

TEST(TrainerCommand, BallPositionKeepsVelocityAndSpin) {
  Trained t;
  t.command("(ball (pos 1 2 0.5)(vel 3 4 5))");
  EXPECT_EQ(t.ball(), Vector3f(1.0F, 2.0F, 0.5F));
  EXPECT_EQ(t.sim.world().ballVelocity(), Vector3f(3.0F, 4.0F, 5.0F));
  t.command("(ball (pos -1 -2 0.7))");
  EXPECT_EQ(t.sim.world().ballVelocity(), Vector3f(3.0F, 4.0F, 5.0F));
  t.placeBall(0.0, 0.0, 0.042, 2.0, 0.0, 0.0);
  t.seconds(1.0);
  ASSERT_GT(t.sim.world().ballAngularVelocity().norm(), 1.0F) << "it rolls";
  const Vector3f spin = t.sim.world().ballAngularVelocity();
  t.command("(ball (pos 0 0 1))");
  EXPECT_EQ(t.sim.world().ballAngularVelocity(), spin);
  t.command("(ball (vel 1 0 0))");
  EXPECT_EQ(t.sim.world().ballAngularVelocity().norm(), 0.0F);
}

TEST(TrainerCommand, AgentPosKeepsTheRotation) {
  Trained t;
  const RobotHandle robot = t.info(t.left).robot;
  const Eigen::Matrix3f before = t.sim.world().bodyPose(robot, model::BodyId::Torso).rotation;
  t.command("(agent (team Left)(unum 2)(pos -3 4 0.5))");
  t.step();
  EXPECT_NEAR(t.torso(t.left).x(), -3.0, 1e-3);
  EXPECT_NEAR(t.torso(t.left).y(), 4.0, 1e-3);
  EXPECT_LT((t.sim.world().bodyPose(robot, model::BodyId::Torso).rotation - before).norm(), 0.02F);
  EXPECT_NEAR(t.torso(t.right).x(), 5.0, 0.01) << "the other one stays";
}

TEST(TrainerCommand, AgentMoveTurnsItUpright) {
  Trained t;
  t.command("(agent (team Right)(unum 3)(move 2 -3 0.4 90))");
  t.step();
  const ScenePose& pose = t.sim.world().bodyPose(t.info(t.right).robot, model::BodyId::Torso);
  EXPECT_NEAR(t.torso(t.right).x(), 2.0, 1e-3);
  EXPECT_NEAR(pose.rotation.col(1).x(), -1.0, 1e-3) << "0 faces +y, 90 faces -x, for both teams";
  EXPECT_NEAR(pose.rotation(2, 2), 1.0, 1e-3);
}

TEST(TrainerCommand, AgentWithoutNameMovesTheSelectedTowardsTheirGoal) {
  Trained t;
  t.command("(agent (pos 0 0 1))");
  t.step();
  EXPECT_NEAR(t.torso(t.left).x(), -5.0, 0.01) << "nobody is selected";
  t.command("(select (team Right)(unum 3))(agent)");
  t.step();
  EXPECT_NEAR(t.torso(t.right).x(), 7.5, 0.01);
  EXPECT_NEAR(t.torso(t.left).x(), -5.0, 0.01);
}

TEST(TrainerCommand, SelectOneTheNextAndNone) {
  Trained t;
  const auto selected = [&] {
    std::vector<AgentHandle> handles;
    for (const AgentInfo& info : t.sim.agents()) {
      if (info.selected) handles.push_back(info.handle);
    }
    return handles;
  };
  t.command("(select (team Left)(unum 2))");
  EXPECT_EQ(selected(), std::vector{t.left});
  t.command("(select)");
  EXPECT_EQ(selected(), std::vector{t.right});
  t.command("(select)");
  EXPECT_EQ(selected(), std::vector{t.left}) << "after the last comes the first";
  t.command("(select (unum -1))");
  EXPECT_TRUE(selected().empty());
  t.command("(select)");
  EXPECT_EQ(selected(), std::vector{t.left});
}

TEST(TrainerCommand, KillRemovesTheRobotAndFreesTheNumber) {
  Trained t;
  t.command("(kill (team Left)(unum 2))");
  t.step();
  EXPECT_FALSE(t.sim.isConnected(t.left));
  EXPECT_EQ(t.sim.world().robots().size(), 1U);
  EXPECT_EQ(t.info(t.add(TeamSide::Left, 2)).unum, 2);
  t.command("(select (team Right)(unum 3))(kill)");
  t.step();
  EXPECT_FALSE(t.sim.isConnected(t.right));
}

TEST(TrainerCommand, ReposPutsARobotOutside) {
  Trained t;
  t.placeBall(0.0, -3.0);
  t.command("(repos (team Right)(unum 3))");
  t.step();
  EXPECT_NEAR(t.torso(t.right).x(), 0.6 * (7 - 3), 1e-3);
  EXPECT_NEAR(t.torso(t.right).y(), 10.5, 1e-3);
  EXPECT_NEAR(t.torso(t.right).z(), 1.0, 0.01);
}

TEST(TrainerCommand, TimeAndScore) {
  Trained t;
  t.command("(time 123.5)(score (left 2)(right 1))");
  EXPECT_EQ(t.sim.match().time, 123.5F);
  EXPECT_EQ(t.sim.match().scoreLeft, 2);
  EXPECT_EQ(t.sim.match().scoreRight, 1);
  t.command("(time -1)(score (left 5))(score (left -1)(right 0))");
  EXPECT_EQ(t.sim.match().time, 123.5F);
  EXPECT_EQ(t.sim.match().scoreLeft, 2) << "both are required and none may be negative";
}

TEST(TrainerCommand, ReqfullstateAndKillsim) {
  Trained t;
  const auto scene = t.sim.sceneVersion();
  EXPECT_TRUE(t.sim.trainer("(reqfullstate)"));
  EXPECT_NE(t.sim.sceneVersion(), scene);
  EXPECT_FALSE(t.sim.trainer("(killsim)"));
}

TEST(TrainerCommand, UnknownMalformedAndUnfinishedOnesAreIgnored) {
  Trained t;
  const auto signature = t.sim.signature();
  for (const char* text : {"(init)",
                           "(getAck)",
                           "(nothing 1 2)",
                           "ball",
                           "()",
                           "(ball (pos 1 2))",
                           "(ball (pos nan 0 0))",
                           "(agent (team Left)(unum 9)(pos 0 0 1))",
                           "(agent (team Left)(unum 2)(move 0 0 inf 0))",
                           "(playMode",
                           "(kickOff)",
                           "(time)",
                           "(((((",
                           "(ball (pos 1 2 3)",
                           "(time nan)",
                           "(time inf)",
                           "(time 1e30)",
                           "(ball (pos 1e30 0 0))",
                           "(ball (vel 0 -1e9 0))",
                           "(score (left nan)(right 1))",
                           "(score (left 1e20)(right 1))",
                           "(select (unum nan)(team Left))",
                           "(kill (unum 1e30)(team Left))",
                           "(agent (unum -1e30)(team Left)(pos 0 0 1))"}) {
    EXPECT_TRUE(t.sim.trainer(text)) << text;
    EXPECT_EQ(t.sim.signature(), signature) << text;
  }
}

TEST(TrainerCommand, SeveralInOneMessage) {
  Trained t;
  t.command("(playMode KickOff_Left) (time 5)\n(ball (pos 1 1 1))");
  EXPECT_EQ(t.mode(), PlayMode::KickOffLeft);
  EXPECT_EQ(t.sim.match().time, 5.0F);
  EXPECT_EQ(t.ball().x(), 1.0F);
}

}  // namespace
}  // namespace nonet::sim::test
