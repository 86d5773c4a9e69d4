// Rules of server facts 4 where they meet each other or the server's own oddities; the plain cases are in the
// other referee tests.
#include <utility>

#include <gtest/gtest.h>

#include "scenario.h"

namespace nonet::sim::test {
namespace {

using model::JointId;

// -- clock and kick-off

TEST(GameOver, TheFoulRulesKeepRunning) {
  Settings settings = quietSettings();
  settings.groundMaxTime = 1.0;
  Scenario s(settings);
  const AgentHandle player = s.add(TeamSide::Left, 2);
  s.setMode(PlayMode::GameOver);
  for (int i = 0; i < 60 && s.countFouls(FoulType::Incapable) == 0; ++i) {
    s.sink(player, 0.1);
    s.step();
  }
  EXPECT_GT(s.countFouls(FoulType::Incapable), 0);
  EXPECT_EQ(s.mode(), PlayMode::GameOver);
}

TEST(KickOff, WithCoinTossTheFirstOneIsTossedToo) {
  Settings settings = quietSettings();
  settings.coinTossForKickOff = true;
  int left = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Simulation simulation(settings, seed);
    simulation.trainer("(kickOff None)");
    left += simulation.match().playMode == PlayMode::KickOffLeft ? 1 : 0;
  }
  EXPECT_GT(left, 8);
  EXPECT_LT(left, 32);
}

// -- pass mode

struct Pass : Scenario {
  Pass() {
    left2 = add(TeamSide::Left, 2);
    right2 = add(TeamSide::Right, 2);
    add(TeamSide::Left, 3);
    setMode(PlayMode::PlayOn);
    placeBall(0.0, 0.0);
    place(left2, -0.4, 0.0);
    place(right2, 6.0, 3.0, 180.0);
    seconds(0.1);
  }
  void ask(AgentHandle agent) {
    protocol::Effectors request;
    request.pass = true;
    sim.act(agent, request);
    step();
  }
  AgentHandle left2, right2;
};

TEST(PassMode, ABallThatGoesOutMeanwhileIsAKickIn) {
  Pass m;
  m.touch(m.left2);
  m.step();
  m.placeBall(0.0, 0.0);
  m.seconds(0.5);
  m.place(m.left2, -0.4, 0.0);
  m.seconds(0.1);
  m.ask(m.left2);
  ASSERT_EQ(m.mode(), PlayMode::PassLeft);
  m.placeBall(0.0, 10.2);
  m.step();
  EXPECT_EQ(m.mode(), PlayMode::KickInRight);
}

TEST(PassMode, ASetPieceCancelsTheBan) {
  Pass m;
  m.ask(m.left2);
  ASSERT_TRUE(m.waitFor(PlayMode::PlayOn, 4.2));
  ASSERT_GT(m.sim.match().passModeScoreWaitLeft, 0.0F);
  m.setMode(PlayMode::CornerKickLeft);
  m.seconds(1.2);
  m.touch(m.left2);
  m.step(2);
  ASSERT_EQ(m.mode(), PlayMode::PlayOn);
  EXPECT_EQ(m.sim.match().passModeScoreWaitLeft, 0.0F);
}

TEST(PassMode, TheOpponentsPassModeCancelsTheBan) {
  Pass m;
  m.ask(m.left2);
  ASSERT_TRUE(m.waitFor(PlayMode::PlayOn, 4.2));
  m.place(m.left2, -6.0, 0.0);
  m.place(m.right2, 0.4, 0.0, 180.0);
  m.placeBall(0.0, 0.0);
  m.seconds(0.1);
  m.ask(m.right2);
  ASSERT_EQ(m.mode(), PlayMode::PassRight);
  ASSERT_TRUE(m.waitFor(PlayMode::PlayOn, 4.2));
  EXPECT_EQ(m.sim.match().passModeScoreWaitLeft, 0.0F);
  EXPECT_GT(m.sim.match().passModeScoreWaitRight, 0.0F);
}

// -- set pieces

TEST(IndirectKick, AnOwnGoalFromItIsACornerForTheOpponent) {
  Pass m;
  m.setMode(PlayMode::FreeKickLeft);
  m.seconds(1.2);
  m.touch(m.left2);
  m.step(2);
  m.placeBall(-15.05, 0.0);
  m.step();
  EXPECT_EQ(m.mode(), PlayMode::CornerKickRight);
  EXPECT_EQ(m.sim.match().scoreRight, 0);
}

// -- fouls

TEST(IllegalDefence, WithBeamPenaltyThePlayerIsRemoved) {
  Settings settings = quietSettings();
  settings.illegalDefenseBeamPenalty = true;
  settings.foulHoldTime = 0.0;
  Scenario s(settings);
  for (int unum = 2; unum <= 4; ++unum) {
    s.place(s.add(TeamSide::Left, unum), -14.2, -2.4 + 1.2 * (unum - 2));
  }
  const AgentHandle late = s.add(TeamSide::Left, 5);
  s.place(late, -12.0, 2.0);
  s.setMode(PlayMode::PlayOn);
  s.placeBall(0.0, 8.0);
  s.step(3);
  s.place(late, -13.4, 2.0);
  s.step(3);
  EXPECT_NEAR(s.torso(late).y(), -10.5, 0.01) << "outside, away from the ball";
}

// The feet record no contacts, so robots whose feet alone touch make no group.
TEST(Touching, FeetAloneDoNotCount) {
  Scenario s;
  std::vector<AgentHandle> players;
  for (int unum = 2; unum <= 4; ++unum) players.push_back(s.add(TeamSide::Left, unum));
  s.setMode(PlayMode::PlayOn);
  s.placeBall(0.0, 8.0);
  s.step(2);
  // The feet reach 0.105 m ahead and 0.055 m back, everything else much less; arms are turned up.
  for (int i = 0; i < 30; ++i) {
    for (std::size_t k = 0; k < players.size(); ++k) {
      protocol::Effectors up;
      up.setSpeed(JointId::RArm1, 6.0);
      up.setSpeed(JointId::LArm1, 6.0);
      s.sim.act(players[k], up);
      s.place(players[k], -4.0 + 2.0 * static_cast<double>(k), 2.0);
    }
    s.step();
  }
  for (std::size_t k = 0; k < players.size(); ++k) {
    s.place(players[k], -4.0 + 0.15 * static_cast<double>(k), 2.0);
  }
  bool feetTouch = false;
  for (int i = 0; i < 2; ++i) {
    s.step();
    for (const ContactPair& pair : s.sim.world().contacts()) {
      if (pair.first.kind != ContactParty::Kind::Robot || pair.second.kind != ContactParty::Kind::Robot) {
        continue;
      }
      const auto isFoot = [](model::BodyId body) {
        return body == model::BodyId::RFoot || body == model::BodyId::LFoot;
      };
      ASSERT_TRUE(isFoot(pair.first.body) && isFoot(pair.second.body)) << "the scene is wrong";
      feetTouch = true;
    }
  }
  EXPECT_TRUE(feetTouch);
  EXPECT_EQ(s.countFouls(FoulType::Touching), 0);
}

// Two legs side by side overlap, but their edges are nearly parallel: the server's test misses that.
TEST(SelfCollision, NearlyParallelBoxesAreMissed) {
  Scenario s;
  const AgentHandle player = s.add(TeamSide::Left, 2);
  s.place(player, -5.0, 2.0, 0.0, 1.0);
  s.setMode(PlayMode::PlayOn);
  protocol::Effectors inwards;
  inwards.setSpeed(JointId::RLeg2, 2.0);
  inwards.setSpeed(JointId::LLeg2, -2.0);
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
  world.setJointSpeed(robot, JointId::Head1, 1.0F);
  world.freezeJoint(robot, JointId::Head1, true);
  const float before = world.jointAngle(robot, JointId::Head1);
  s.step(5);
  EXPECT_NEAR(world.jointAngle(robot, JointId::Head1) - before, 0.1, 0.01);
  protocol::Effectors command;
  command.setSpeed(JointId::Head1, 1.0);
  s.sim.act(player, command);
  s.step();
  const float frozen = world.jointAngle(robot, JointId::Head1);
  s.step(5);
  EXPECT_NEAR(world.jointAngle(robot, JointId::Head1), frozen, 0.005);
}

}  // namespace
}  // namespace nonet::sim::test
