// Scene and init: who gets a robot, a number and a side, and where it is born (server facts 1).
#include "sim/handshake.h"

#include <array>

#include <gtest/gtest.h>

#include "nonet/sim/referee/game_state.h"

#include "sim/scenario.h"

namespace nonet::sim::test {
namespace {

TEST(Handshake, NoMessageBeforeARobotExistsAndNumberOnceInTheSecondAfterInit) {
  Simulation simulation(quietSettings());
  const AgentHandle agent = simulation.connect();
  simulation.step();
  EXPECT_EQ(simulation.sense(agent), nullptr);
  simulation.act(agent, sceneMessage(0));
  simulation.step();
  EXPECT_EQ(simulation.sense(agent), nullptr);
  simulation.step();
  EXPECT_EQ(simulation.sense(agent), nullptr);
  simulation.step();
  ASSERT_NE(simulation.sense(agent), nullptr) << "two cycles after the robot was built";
  EXPECT_FALSE(simulation.sense(agent)->game.unum);

  simulation.act(agent, initMessage(7, "A"));
  simulation.step();
  EXPECT_FALSE(simulation.sense(agent)->game.unum) << "first message after init";
  simulation.step();
  EXPECT_EQ(simulation.sense(agent)->game.unum, 7) << "second message after init";
  EXPECT_EQ(simulation.sense(agent)->game.side, TeamSide::Left);
  simulation.step();
  EXPECT_FALSE(simulation.sense(agent)->game.unum) << "only once";
}

TEST(Handshake, TheRobotIsBornAtItsPlace) {
  Simulation simulation(quietSettings());
  const AgentHandle agent = simulation.connect();
  simulation.act(agent, sceneMessage(0));
  simulation.step();
  const AgentInfo info = simulation.agents().at(0);
  ASSERT_EQ(info.handle, agent);
  const Vector3f torso = simulation.world().bodyPosition(info.robot, model::BodyId::Torso);
  EXPECT_NEAR(torso.x(), 0.0, 1e-4);
  EXPECT_NEAR(torso.y(), -1.0, 1e-4);
  EXPECT_NEAR(torso.z(), 1.5, 0.005);
  EXPECT_EQ(info.unum, 0);
}

TEST(Handshake, WhatComesWithTheSceneMessageIsLost) {
  Simulation simulation(quietSettings());
  const AgentHandle agent = simulation.connect();
  protocol::Effectors both = sceneMessage(0);
  both.init = initMessage(3, "A").init;
  simulation.act(agent, both);
  for (int i = 0; i < 5; ++i) simulation.step();
  EXPECT_EQ(simulation.agents().at(0).unum, 0);
}

TEST(Handshake, UnknownSceneFilesAndTypesBuildNothing) {
  Simulation simulation(quietSettings());
  const AgentHandle agent = simulation.connect();
  protocol::Effectors file;
  file.scene = protocol::SceneEffector{0, InlineString<96>("rsg/agent/other.rsg")};
  simulation.act(agent, file);
  simulation.step();
  simulation.act(agent, sceneMessage(5));
  simulation.step();
  EXPECT_EQ(simulation.agents().at(0).robot, kNoRobot);
}

TEST(Handshake, StartPositionsWalkDownTheColumn) {
  Scenario scenario;
  // 16 steps of 1.2 m from 9.2 reach -8.8; the next would be -10, which is not below -W/2 yet.
  double y = 9.2;
  double x = -14.2;
  for (int unum = 1; unum <= 11; ++unum) {
    const AgentHandle agent = scenario.add(TeamSide::Left, unum, unum % 5);
    EXPECT_NEAR(scenario.torso(agent).x(), x, 1e-3) << unum;
    EXPECT_NEAR(scenario.torso(agent).y(), y, 1e-3) << unum;
    y -= 1.2;
  }
  const AgentHandle right = scenario.add(TeamSide::Right, 1);
  EXPECT_NEAR(scenario.torso(right).x(), 14.2, 1e-3);
  EXPECT_NEAR(scenario.torso(right).y(), 9.2, 1e-3);
  const ScenePose& pose = scenario.sim.world().bodyPose(scenario.info(right).robot, model::BodyId::Torso);
  EXPECT_NEAR(pose.rotation.col(1).x(), -1.0, 1e-3) << "the right team looks along -x";
}

TEST(Handshake, LowestFreeNumberForZero) {
  Scenario scenario;
  scenario.add(TeamSide::Left, 1);
  scenario.add(TeamSide::Left, 3);
  EXPECT_EQ(scenario.info(scenario.add(TeamSide::Left, 0)).unum, 2);
  EXPECT_EQ(scenario.info(scenario.add(TeamSide::Left, 0)).unum, 4);
}

TEST(Handshake, RefusedInitsDropTheRobotFromTheSky) {
  Simulation simulation(quietSettings());
  introduce(simulation, 0, 1, "A");
  introduce(simulation, 0, 1, "B");
  struct Case {
    int unum;
    std::string_view team;
    const char* why;
  };
  for (const Case& c : {Case{2, "C", "third team"}, Case{1, "A", "number taken"}, Case{12, "A", "above 11"},
                        Case{-1, "A", "negative"}}) {
    const AgentHandle agent = introduce(simulation, 1, c.unum, c.team);
    const AgentInfo info = simulation.agents().back();
    ASSERT_EQ(info.handle, agent);
    EXPECT_EQ(info.unum, 0) << c.why;
    EXPECT_EQ(info.side, TeamSide::None) << c.why;
    const Vector3f torso = simulation.world().bodyPosition(info.robot, model::BodyId::Torso);
    EXPECT_NEAR(torso.z(), 10.0, 0.01) << c.why;
    for (int i = 0; i < 4; ++i) simulation.step();
    EXPECT_EQ(textOf(simulation, agent).find("(unum "), std::string::npos) << c.why;
    simulation.disconnect(agent);
    simulation.step();
  }
}

TEST(Handshake, TeamNamesStayWhenAllPlayersHaveLeft) {
  Simulation simulation(quietSettings());
  const AgentHandle a = introduce(simulation, 0, 1, "A");
  simulation.disconnect(a);
  simulation.step();
  introduce(simulation, 0, 1, "B");
  EXPECT_EQ(simulation.agents().back().side, TeamSide::Right);
  introduce(simulation, 0, 1, "A");
  EXPECT_EQ(simulation.agents().back().side, TeamSide::Left);
  EXPECT_EQ(simulation.agents().back().unum, 1) << "the number is free again";
}

TEST(Handshake, SideOfANamedTeamCanBeFixed) {
  Settings settings = quietSettings();
  settings.rightTeam = "B";
  Simulation simulation(settings);
  introduce(simulation, 0, 1, "B");
  EXPECT_EQ(simulation.agents().back().side, TeamSide::Right);
  introduce(simulation, 0, 1, "A");
  EXPECT_EQ(simulation.agents().back().side, TeamSide::Left);
}

// Server facts 1.4, spelled out again: brute force over many random teams.
TEST(Handshake, RobotTypeRules) {
  Random random(5);
  int refusals = 0;
  for (int round = 0; round < 200; ++round) {
    const Settings settings = quietSettings();
    GameState game(settings);
    std::array<int, 5> count{};
    for (int n = 0; n < 11; ++n) {
      const int type =
          random.below(3) > 0 ? static_cast<int>(random.below(2)) : static_cast<int>(random.below(5));
      int robots = 0;
      int types = 0;
      bool sumTooLarge = count[type] + 1 > 9;
      for (int other = 0; other < 5; ++other) {
        robots += count[other];
        types += count[other] > 0 ? 1 : 0;
        if (other != type && count[type] + 1 + count[other] > 9) sumTooLarge = true;
      }
      const bool refused = count[type] == 7 || sumTooLarge || (11 - robots <= 3 - types && count[type] > 0);
      TeamSide side = TeamSide::None;
      int unum = 0;
      const auto answer = game.registerPlayer("A", type, side, unum, settings);
      ASSERT_EQ(answer == GameState::Refusal::TypeRule, refused)
          << "type " << type << " as number " << robots + 1;
      if (refused) {
        ++refusals;
        continue;
      }
      ++count[type];
      EXPECT_EQ(unum, robots + 1) << "a refusal leaks no number";
    }
  }
  EXPECT_GT(refusals, 50);
}

}  // namespace
}  // namespace nonet::sim::test
