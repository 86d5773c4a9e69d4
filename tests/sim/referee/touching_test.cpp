// Touching: server facts 4.10, one scenario per rule.
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "sim/scenario.h"

namespace nonet::sim::test {
namespace {

// Three robots in a row, arms touching.
TEST(Touching, TheThirdRobotInAGroupIsMovedAway) {
  Field f;
  const AgentHandle a = f.add(TeamSide::Left, 2);
  const AgentHandle b = f.add(TeamSide::Right, 2);
  const AgentHandle c = f.add(TeamSide::Left, 3);
  f.place(a, 0.0, 0.0);
  f.place(b, 0.0, 0.22);
  f.place(c, 0.0, -3.0);
  f.play();
  f.step(3);
  EXPECT_EQ(f.countFouls(FoulType::Touching), 0) << "two may touch";
  f.place(a, 0.0, 0.0);
  f.place(b, 0.0, 0.22);
  f.place(c, 0.0, -0.22);
  f.step(1);
  ASSERT_EQ(f.countFouls(FoulType::Touching), 1);
  const FoulRecord foul = f.sim.fouls().back();
  EXPECT_EQ(foul.unum, 3) << "the one who was alone before";
  EXPECT_EQ(foul.side, TeamSide::Left);
  EXPECT_LT(f.torso(c).y(), -0.4F);
}

TEST(Touching, TheLargerTeamIsPunishedAndTheGoalkeeperSpared) {
  Field f;
  const AgentHandle goalie = f.add(TeamSide::Left, 1);
  const AgentHandle mate = f.add(TeamSide::Left, 3);
  const AgentHandle opponent = f.add(TeamSide::Right, 2);
  f.place(goalie, 0.0, -3.0);
  f.place(mate, 0.0, 0.0);
  f.place(opponent, 0.0, 0.22);
  f.play();
  f.step(3);
  f.place(mate, 0.0, 0.0);
  f.place(opponent, 0.0, 0.22);
  f.place(goalie, 0.0, -0.22);
  f.step(1);
  ASSERT_EQ(f.countFouls(FoulType::Touching), 1);
  EXPECT_EQ(f.sim.fouls().back().unum, 3) << "the goalkeeper came last, but its team mate goes";
}

TEST(Touching, ALargerGroupMayBeAllowed) {
  Settings settings = quietSettings();
  settings.maxTouchGroupSize = 3;
  Field f(settings);
  const AgentHandle a = f.add(TeamSide::Left, 2);
  const AgentHandle b = f.add(TeamSide::Right, 2);
  const AgentHandle c = f.add(TeamSide::Left, 3);
  f.place(a, 0.0, 0.0);
  f.place(b, 0.0, 0.22);
  f.place(c, 0.0, -0.22);
  f.play();
  f.step(3);
  EXPECT_EQ(f.countFouls(FoulType::Touching), 0);
}

TEST(Touching, WithBeamPenaltyTheRobotIsRemoved) {
  Settings settings = quietSettings();
  settings.touchingFoulBeamPenalty = true;
  settings.foulHoldTime = 0.0;
  Field f(settings);
  const AgentHandle a = f.add(TeamSide::Left, 2);
  const AgentHandle b = f.add(TeamSide::Right, 2);
  const AgentHandle c = f.add(TeamSide::Left, 3);
  f.place(a, 0.0, 0.0);
  f.place(b, 0.0, 0.22);
  f.place(c, 0.0, -3.0);
  f.play();
  f.step(2);
  f.place(a, 0.0, 0.0);
  f.place(b, 0.0, 0.22);
  f.place(c, 0.0, -0.22);
  f.step(1);
  EXPECT_NEAR(std::abs(f.torso(c).y()), 10.5, 0.01);
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
      up.setSpeed(model::JointId::RArm1, 6.0);
      up.setSpeed(model::JointId::LArm1, 6.0);
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

TEST(Touching, ANewcomerAgainstTwoIsNotPunished) {
  Field f;
  const AgentHandle newcomer = f.add(TeamSide::Left, 2);
  const AgentHandle a = f.add(TeamSide::Right, 2);
  const AgentHandle b = f.add(TeamSide::Right, 3);
  f.place(newcomer, 0.0, -3.0);
  f.place(a, 0.0, 0.0);
  f.place(b, 0.0, 0.22);
  f.play();
  f.place(a, 0.0, 0.0);
  f.place(b, 0.0, 0.22);
  f.step(2);
  f.place(a, 0.0, 0.0);
  f.place(b, 0.0, 0.22);
  f.place(newcomer, 0.0, -0.22);
  f.step();
  ASSERT_EQ(f.countFouls(FoulType::Touching), 1);
  EXPECT_EQ(f.sim.fouls().back().side, TeamSide::Right) << "its team has less than half of the group";
}

TEST(Touching, GoesOnUntilTheGroupIsSmallEnough) {
  Field f;
  std::vector<AgentHandle> row;
  for (int i = 0; i < 4; ++i) {
    row.push_back(f.add(i % 2 == 0 ? TeamSide::Left : TeamSide::Right, 2 + i));
    f.place(row.back(), 0.0, 3.0 * i);
  }
  f.play(-8.0, 0.0);
  for (int i = 0; i < 4; ++i) f.place(row[static_cast<std::size_t>(i)], 0.0, 0.22 * i);
  f.step();
  EXPECT_EQ(f.countFouls(FoulType::Touching), 2);
}

}  // namespace
}  // namespace nonet::sim::test
