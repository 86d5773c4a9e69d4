// Clock, halves, kick-off, goals: server facts 4.2 to 4.5, one scenario per rule.
#include <gtest/gtest.h>

#include "scenario.h"

namespace nonet::sim::test {
namespace {

Settings shortHalves(double seconds) {
  Settings settings = quietSettings();
  settings.ruleHalfTime = seconds;
  return settings;
}

TEST(Clock, StandsStillBeforeKickOffAndRunsInAllOtherModes) {
  Scenario s;
  s.add(TeamSide::Left, 1);
  s.seconds(0.5);
  EXPECT_EQ(s.sim.match().time, 0.0F);
  for (int mode = 1; mode < protocol::kPlayModeCount; ++mode) {
    const auto playMode = static_cast<PlayMode>(mode);
    if (playMode == PlayMode::GameOver) continue;
    s.setMode(playMode);
    const float before = s.sim.match().time;
    s.step();
    EXPECT_EQ(s.sim.match().time, before + 0.02F) << protocol::playModeName(playMode);
  }
}

TEST(Clock, StandsStillAfterTheEnd) {
  Scenario s;
  s.add(TeamSide::Left, 1);
  s.setMode(PlayMode::GameOver);
  s.seconds(0.2);
  EXPECT_EQ(s.sim.match().time, 0.0F);
  EXPECT_EQ(s.mode(), PlayMode::GameOver);
}

TEST(Clock, GameTimeIsAFloatSum) {
  Scenario s;
  s.setMode(PlayMode::PlayOn);
  float sum = 0.0F;
  for (int i = 0; i < 365; ++i) {
    s.step();
    sum += 0.02F;
  }
  EXPECT_EQ(s.sim.match().time, sum);
  EXPECT_NE(sum, 7.3F) << "it drifts, as in the server";
}

TEST(Halves, SecondHalfStartsAtHalfTimeWithTheTimeKept) {
  Scenario s(shortHalves(1.0));
  s.add(TeamSide::Left, 1);
  s.setMode(PlayMode::PlayOn);
  ASSERT_TRUE(s.waitFor(PlayMode::BeforeKickOff, 1.1));
  EXPECT_EQ(s.sim.match().half, 2);
  EXPECT_NEAR(s.sim.match().time, 1.0, 0.021);
  const float time = s.sim.match().time;
  s.setMode(PlayMode::PlayOn);
  s.step();
  EXPECT_EQ(s.sim.match().time, time + 0.02F);
  EXPECT_TRUE(s.waitFor(PlayMode::GameOver, 1.1));
  EXPECT_NEAR(s.sim.match().time, 2.0, 0.021);
}

TEST(Halves, SingleHalfTimeEndsTheGame) {
  Settings settings = shortHalves(0.5);
  settings.singleHalfTime = true;
  Scenario s(settings);
  s.setMode(PlayMode::PlayOn);
  EXPECT_TRUE(s.waitFor(PlayMode::GameOver, 0.6));
}

TEST(Halves, ChangeSidesInSecondHalfSwapsTeamsWithNamesAndScores) {
  Settings settings = shortHalves(0.5);
  settings.changeSidesInSecondHalf = true;
  Scenario s(settings);
  const AgentHandle left = s.add(TeamSide::Left, 1);
  const AgentHandle right = s.add(TeamSide::Right, 2);
  s.place(left, -5.0, 1.0);
  s.place(right, 5.0, 1.0);
  s.command("(score (left 3)(right 1))");
  const auto scene = s.sim.sceneVersion();
  s.setMode(PlayMode::PlayOn);
  ASSERT_TRUE(s.waitFor(PlayMode::BeforeKickOff, 0.6));
  EXPECT_EQ(s.sim.match().teamLeft, "R");
  EXPECT_EQ(s.sim.match().teamRight, "L");
  EXPECT_EQ(s.sim.match().scoreLeft, 1);
  EXPECT_EQ(s.sim.match().scoreRight, 3);
  EXPECT_EQ(s.info(left).side, TeamSide::Right);
  EXPECT_NE(s.sim.sceneVersion(), scene) << "monitors get the new names";
  s.step(2);
  // Robots kept their place, are now in the wrong half and get cleared.
  EXPECT_NEAR(s.torso(left).x(), 2.5, 0.1);
  EXPECT_NEAR(s.torso(right).x(), -2.5, 0.1);
  s.setMode(PlayMode::GoalLeft);
  protocol::Effectors beam;
  beam.beam = Pose2(-7.0, 2.0, 0.0);
  s.sim.act(left, beam);
  s.step();
  EXPECT_NEAR(s.torso(left).x(), 7.0, 0.01) << "beams are turned without a word";
}

TEST(Halves, ScoresOfTheTrainerStayWithTheTeamsAfterTheChange) {
  Settings settings = shortHalves(0.1);
  settings.changeSidesInSecondHalf = true;
  Scenario s(settings);
  s.add(TeamSide::Left, 1);
  s.setMode(PlayMode::PlayOn);
  ASSERT_TRUE(s.waitFor(PlayMode::BeforeKickOff, 0.2));
  s.command("(score (left 4)(right 0))");
  EXPECT_EQ(s.sim.match().scoreRight, 4);
}

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

// A ball that rolls through the goal mouth; `by` touched it before, outside the restrictions of kick-offs.
void shootAtRightGoal(Scenario& s, AgentHandle by) {
  s.touch(by);
  s.step(1);
  s.placeBall(14.7, 0.0, 0.1, 6.0, 0.0, 0.0);
}

TEST(Goal, CountsWithTheBallsCentreOverTheLine) {
  Scenario s;
  const AgentHandle player = s.add(TeamSide::Left, 2);
  s.setMode(PlayMode::PlayOn);
  s.touch(player);
  s.step();
  s.placeBall(14.99, 0.0, 0.042);
  s.step();
  EXPECT_EQ(s.mode(), PlayMode::PlayOn);
  s.placeBall(15.01, 0.0, 0.042);
  s.step();
  EXPECT_EQ(s.mode(), PlayMode::GoalLeft) << "half of the ball is enough";
  EXPECT_EQ(s.sim.match().scoreLeft, 1);
}

TEST(Goal, NotAboveOrBesideTheGoal) {
  Scenario s;
  const AgentHandle player = s.add(TeamSide::Left, 2);
  s.setMode(PlayMode::PlayOn);
  s.touch(player);
  s.step();
  s.placeBall(15.2, 1.5, 0.042);
  s.step();
  EXPECT_NE(s.mode(), PlayMode::GoalLeft);
  s.setMode(PlayMode::PlayOn);
  s.placeBall(15.2, 0.0, 1.2);
  s.step();
  EXPECT_NE(s.mode(), PlayMode::GoalLeft);
  EXPECT_EQ(s.sim.match().scoreLeft, 0);
}

TEST(Goal, AFastBallIsFoundByItsVelocity) {
  // 200 m/s: four metres per cycle, past the trigger box.
  for (const double sign : {1.0, -1.0}) {
    Scenario s;
    const AgentHandle player = s.add(TeamSide::Left, 2);
    s.setMode(PlayMode::PlayOn);
    s.touch(player);
    s.step();
    s.placeBall(sign * 15.9, 0.0, 0.3, sign * 2.0, 0.0, 0.0);
    s.step();
    EXPECT_EQ(s.mode(), sign > 0 ? PlayMode::GoalLeft : PlayMode::GoalRight);
  }
}

TEST(Goal, KickOffForTheOtherTeamAfterThePause) {
  Scenario s;
  const AgentHandle player = s.add(TeamSide::Left, 2);
  s.setMode(PlayMode::PlayOn);
  shootAtRightGoal(s, player);
  ASSERT_TRUE(s.waitFor(PlayMode::GoalLeft, 0.5));
  s.seconds(2.9);
  EXPECT_EQ(s.mode(), PlayMode::GoalLeft);
  ASSERT_TRUE(s.waitFor(PlayMode::KickOffRight, 0.2));
  EXPECT_NEAR(s.ball().x(), 0.0, 1e-3);
  EXPECT_EQ(s.sim.match().scoreLeft, 1);
  EXPECT_EQ(s.sim.match().scoreRight, 0);
}

TEST(Goal, TheKickOffTeamMayNotScoreFromTheCircle) {
  Scenario s;
  const AgentHandle kicker = s.add(TeamSide::Left, 2);
  s.add(TeamSide::Left, 3);
  s.add(TeamSide::Right, 2);  // more than two clients
  s.command("(kickOff Left)");
  s.step(3);
  s.touch(kicker);
  ASSERT_TRUE(s.waitFor(PlayMode::PlayOn, 0.2));
  s.placeBall(14.8, 0.0, 0.1, 5.0, 0.0, 0.0);
  ASSERT_TRUE(s.waitFor(PlayMode::GoalKickRight, 0.5));
  EXPECT_EQ(s.sim.match().scoreLeft, 0);
}

TEST(Goal, TheKickOffTeamMayScoreAfterAnOpponentsTouchOrOutsideTheCircle) {
  for (const bool opponentTouches : {true, false}) {
    Scenario s;
    const AgentHandle kicker = s.add(TeamSide::Left, 2);
    const AgentHandle mate = s.add(TeamSide::Left, 3);
    const AgentHandle opponent = s.add(TeamSide::Right, 2);
    s.place(mate, -8.0, 3.0);
    s.place(opponent, 6.0, 3.0);
    s.command("(kickOff Left)");
    s.step(3);
    s.touch(kicker);
    ASSERT_TRUE(s.waitFor(PlayMode::PlayOn, 0.2));
    s.seconds(0.2);
    s.touch(opponentTouches ? opponent : mate);
    s.step();
    s.placeBall(14.8, 0.0, 0.1, 5.0, 0.0, 0.0);
    EXPECT_TRUE(s.waitFor(PlayMode::GoalLeft, 0.5)) << opponentTouches;
  }
}

TEST(Goal, WithTwoClientsEverythingCounts) {
  Scenario s;
  const AgentHandle kicker = s.add(TeamSide::Left, 2);
  s.command("(kickOff Left)");
  s.step(3);
  s.touch(kicker);
  ASSERT_TRUE(s.waitFor(PlayMode::PlayOn, 0.2));
  s.placeBall(14.8, 0.0, 0.1, 5.0, 0.0, 0.0);
  EXPECT_TRUE(s.waitFor(PlayMode::GoalLeft, 0.5));
}

TEST(Goal, AnOwnGoalCountsForTheOpponent) {
  Scenario s;
  const AgentHandle player = s.add(TeamSide::Left, 2);
  s.setMode(PlayMode::PlayOn);
  s.touch(player);
  s.step();
  s.placeBall(-15.05, 0.0, 0.042);
  s.step();
  EXPECT_EQ(s.mode(), PlayMode::GoalRight);
  EXPECT_EQ(s.sim.match().scoreRight, 1);
}

TEST(GameOver, NothingHappensAnyMore) {
  Settings settings = quietSettings();
  settings.automaticQuit = true;
  Scenario s(settings);
  const AgentHandle player = s.add(TeamSide::Left, 2);
  s.setMode(PlayMode::GameOver);
  s.touch(player);
  s.step();
  s.placeBall(15.05, 0.0, 0.042);
  s.seconds(12.0);
  EXPECT_EQ(s.mode(), PlayMode::GameOver);
  EXPECT_EQ(s.sim.match().scoreLeft, 0);
}

TEST(Offside, TheModesAreDeadEnds) {
  Scenario s;
  const AgentHandle player = s.add(TeamSide::Left, 2);
  for (const PlayMode mode : {PlayMode::OffsideLeft, PlayMode::OffsideRight}) {
    s.setMode(mode);
    s.touch(player);
    s.seconds(16.0);
    EXPECT_EQ(s.mode(), mode);
  }
}

}  // namespace
}  // namespace nonet::sim::test
