// Kick-off: server facts 4.3, one scenario per rule.
#include <gtest/gtest.h>

#include "sim/scenario.h"

namespace nonet::sim::test {
namespace {

TEST(KickOff, BallIsHeldAtTheCentreBeforeIt) {
  Scenario s;
  s.placeBall(3.0, 2.0, 0.5, 1.0, 0.0, 0.0);
  s.step();
  EXPECT_NEAR(s.ball().x(), 3.0, 0.1) << "not while nobody is connected";
  s.add(TeamSide::Left, 1);
  s.placeBall(3.0, 2.0, 0.5, 1.0, 0.0, 0.0);
  s.step();
  EXPECT_NEAR(s.ball().x(), 0.0, 1e-6);
  EXPECT_NEAR(s.ball().y(), 0.0, 1e-6);
  EXPECT_EQ(s.sim.world().ballVelocity().norm(), 0.0F);
}

TEST(KickOff, PlayersInTheWrongHalfAreMovedBackBeforeIt) {
  Scenario s;
  const AgentHandle left = s.add(TeamSide::Left, 1);
  const AgentHandle right = s.add(TeamSide::Right, 1);
  s.place(left, 6.0, 3.0);
  s.place(right, -6.0, -3.0);
  s.step(2);
  EXPECT_NEAR(s.torso(left).x(), -2.5, 0.01);
  EXPECT_NEAR(s.torso(left).y(), 3.0, 0.01);
  EXPECT_NEAR(s.torso(right).x(), 2.5, 0.01);
  EXPECT_NEAR(s.torso(right).y(), -3.0, 0.01);
}

TEST(KickOff, StartAnyFieldPositionClearsNobody) {
  Settings settings = quietSettings();
  settings.startAnyFieldPosition = true;
  Scenario s(settings);
  const AgentHandle left = s.add(TeamSide::Left, 1);
  s.place(left, 6.0, 3.0);
  s.step(2);
  EXPECT_NEAR(s.torso(left).x(), 6.0, 0.01);
  protocol::Effectors beam;
  beam.beam = Pose2(9.0, 2.0, 0.0);
  s.sim.act(left, beam);
  s.step();
  EXPECT_NEAR(s.torso(left).x(), 9.0, 0.01);
}

TEST(KickOff, AutomaticKickOffCountsFromTheFirstClient) {
  Settings settings = quietSettings();
  settings.automaticKickOff = true;
  settings.waitBeforeKickOff = 1.0;
  Scenario s(settings);
  s.seconds(2.0);
  EXPECT_EQ(s.mode(), PlayMode::BeforeKickOff);
  s.sim.connect();
  s.seconds(0.9);
  EXPECT_EQ(s.mode(), PlayMode::BeforeKickOff);
  s.seconds(0.2);
  EXPECT_EQ(s.mode(), PlayMode::KickOffLeft) << "left kicks off first";
}

TEST(KickOff, TheOtherTeamKicksOffInTheSecondHalf) {
  for (const bool change : {false, true}) {
    Settings settings = shortHalves(0.1);
    settings.changeSidesInSecondHalf = change;
    Scenario s(settings);
    s.command("(kickOff None)");
    EXPECT_EQ(s.mode(), PlayMode::KickOffLeft);
    ASSERT_TRUE(s.waitFor(PlayMode::BeforeKickOff, 0.2));
    s.command("(kickOff None)");
    // With change of sides the other team is again the one on the left.
    EXPECT_EQ(s.mode(), change ? PlayMode::KickOffLeft : PlayMode::KickOffRight);
  }
}

TEST(KickOff, LaterOnesAreTossed) {
  int left = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Simulation simulation(quietSettings(), seed);
    simulation.trainer("(kickOff None)(playMode PlayOn)(kickOff None)");
    left += simulation.match().playMode == PlayMode::KickOffLeft ? 1 : 0;
  }
  EXPECT_GT(left, 8);
  EXPECT_LT(left, 32);
}

TEST(KickOff, OpponentsStayOutOfTheCircleAndTheirOwnHalf) {
  Scenario s;
  const AgentHandle inCircle = s.add(TeamSide::Right, 2);
  const AgentHandle wrongHalf = s.add(TeamSide::Right, 3);
  const AgentHandle fine = s.add(TeamSide::Right, 4);
  s.place(inCircle, 1.5, 0.5);
  s.place(wrongHalf, -4.0, 3.0);
  s.place(fine, 5.0, -3.0);
  s.command("(kickOff Left)");
  s.step(2);
  EXPECT_NEAR(s.torso(inCircle).x(), 2.5, 0.01);
  EXPECT_NEAR(s.torso(inCircle).y(), 0.5, 0.01);
  EXPECT_NEAR(s.torso(wrongHalf).x(), 2.5, 0.01);
  EXPECT_NEAR(s.torso(fine).x(), 5.0, 0.01);
}

TEST(KickOff, KickersMayStandInTheWholeCircle) {
  Scenario s;
  const AgentHandle inCircle = s.add(TeamSide::Left, 2);
  const AgentHandle beyond = s.add(TeamSide::Left, 3);
  s.setMode(PlayMode::PlayOn);
  s.place(inCircle, 0.6, 0.5);
  s.place(beyond, 3.0, 4.0);
  s.command("(kickOff Left)");
  s.step(2);
  EXPECT_NEAR(s.torso(inCircle).x(), 0.6, 0.02);
  EXPECT_NEAR(s.torso(beyond).x(), -2.5, 0.01);
}

TEST(KickOff, FirstTouchByAnybodyStartsThePlay) {
  for (const TeamSide side : {TeamSide::Left, TeamSide::Right}) {
    Scenario s;
    const AgentHandle toucher = s.add(side, 2);
    s.command("(kickOff Left)");
    s.step(3);
    EXPECT_EQ(s.mode(), PlayMode::KickOffLeft);
    s.touch(toucher);
    s.step(2);
    EXPECT_EQ(s.mode(), PlayMode::PlayOn);
  }
}

TEST(KickOff, DropBallAfterFifteenSeconds) {
  Scenario s;
  s.command("(kickOff Left)");
  s.seconds(14.9);
  EXPECT_EQ(s.mode(), PlayMode::KickOffLeft);
  EXPECT_TRUE(s.waitFor(PlayMode::PlayOn, 0.3));
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

TEST(KickOff, TheHalvesReachTenMetresBeyondTheField) {
  Scenario s;
  const AgentHandle behindTheGoal = s.add(TeamSide::Left, 2);
  const AgentHandle beside = s.add(TeamSide::Left, 3);
  const AgentHandle farAway = s.add(TeamSide::Left, 4);
  s.place(behindTheGoal, 24.0, 5.0);
  s.place(beside, 3.0, 19.0);
  s.place(farAway, 26.0, -5.0);
  s.step();
  EXPECT_NEAR(s.torso(behindTheGoal).x(), -2.5, 0.01);
  EXPECT_NEAR(s.torso(beside).x(), -2.5, 0.01);
  EXPECT_NEAR(s.torso(farAway).x(), 26.0, 0.01);
}

TEST(KickOff, TheAutomaticOneWaitsAnewInTheSecondHalf) {
  Settings settings = shortHalves(1.0);
  settings.automaticKickOff = true;
  settings.waitBeforeKickOff = 0.5;
  Scenario s(settings);
  s.sim.connect();
  ASSERT_TRUE(s.waitFor(PlayMode::KickOffLeft, 0.6));
  ASSERT_TRUE(s.waitFor(PlayMode::BeforeKickOff, 1.1));
  s.seconds(0.4);
  EXPECT_EQ(s.mode(), PlayMode::BeforeKickOff);
  EXPECT_TRUE(s.waitFor(PlayMode::KickOffRight, 0.2));
}

TEST(KickOff, TheBallIsNotHeldDuringIt) {
  Scenario s;
  s.add(TeamSide::Left, 1);
  s.command("(kickOff Left)");
  s.step();
  s.placeBall(0.5, 0.3, 0.042, 1.0, 0.0, 0.0);
  s.seconds(0.2);
  EXPECT_EQ(s.mode(), PlayMode::KickOffLeft);
  EXPECT_GT(s.ball().x(), 0.6F);
}

TEST(KickOff, KickersMustStandInTheCircleWithAllOfTheirRectangle) {
  Scenario s;
  const AgentHandle inside = s.add(TeamSide::Left, 2);
  const AgentHandle onTheLine = s.add(TeamSide::Left, 3);
  s.setMode(PlayMode::PlayOn);
  s.place(inside, 0.5, 1.6, 0.0);
  s.place(onTheLine, 1.95, 0.0, 0.0);
  s.command("(kickOff Left)");
  s.step();
  EXPECT_NEAR(s.torso(inside).x(), 0.5, 0.02);
  EXPECT_NEAR(s.torso(onTheLine).x(), -2.5, 0.01) << "its arms are beyond the circle";
}

TEST(KickOff, ThatOfTheRightTeamIsTheMirrorImage) {
  Scenario s;
  const AgentHandle waiting = s.add(TeamSide::Left, 2);
  const AgentHandle kicker = s.add(TeamSide::Right, 2);
  const AgentHandle beyond = s.add(TeamSide::Right, 3);
  s.setMode(PlayMode::PlayOn);
  s.place(waiting, -1.5, -1.0);
  s.place(kicker, -0.6, 0.5, 180.0);
  s.place(beyond, -3.0, 4.0, 180.0);
  s.command("(kickOff Right)");
  s.step(2);
  EXPECT_EQ(s.mode(), PlayMode::KickOffRight);
  EXPECT_NEAR(s.torso(waiting).x(), -2.5, 0.01);
  EXPECT_NEAR(s.torso(kicker).x(), -0.6, 0.02);
  EXPECT_NEAR(s.torso(beyond).x(), 2.5, 0.01);
}

TEST(KickOff, AnOwnGoalFromItIsACornerForTheOpponent) {
  Match m;
  m.command("(kickOff Left)");
  m.step();
  m.touch(m.left2);
  ASSERT_TRUE(m.waitFor(PlayMode::PlayOn, 0.1));
  m.placeBall(-15.05, 0.0);
  m.step();
  EXPECT_EQ(m.mode(), PlayMode::CornerKickRight);
  EXPECT_EQ(m.sim.match().scoreRight, 0);
}

TEST(KickOff, AnOpponentWhoTakesItMayNotScoreEither) {
  Match m;
  m.command("(kickOff Left)");
  m.step();
  m.touch(m.right2);
  ASSERT_TRUE(m.waitFor(PlayMode::PlayOn, 0.1));
  m.placeBall(-15.05, 0.0);
  m.step();
  EXPECT_EQ(m.mode(), PlayMode::GoalKickLeft);
  EXPECT_EQ(m.sim.match().scoreRight, 0);
}

}  // namespace
}  // namespace nonet::sim::test
