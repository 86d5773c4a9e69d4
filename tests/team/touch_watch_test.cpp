// The double touch rule as the server applies it (facts 4.5), told as scenes.
#include "nonet/team/touch_watch.h"

#include <gtest/gtest.h>

namespace nonet::team {
namespace {

class Scene : public testing::Test {
 protected:
  Scene() {
    world.game.unum = 9;
    world.ball.known = true;
    ball(0.0, 0.0);
    place(world.teammates[9], -0.2, 0.0);
    place(world.teammates[6], -1.0, -1.0);
    place(world.opponents[8], 2.5, 0.0);
  }
  static void place(world::PlayerState& player, double x, double y) {
    player.known = true;
    player.X_FP = Pose2(x, y, 0.0);
  }
  void ball(double x, double y) { world.ball.p_FB = Vector3(x, y, 0.04); }
  void play(world::Phase phase, double seconds) {
    world.game.phase = phase;
    for (double end = world.time + seconds; world.time < end; world.time += 0.02) watch.update(world);
  }

  world::WorldState world;
  TouchWatch watch;
};

TEST_F(Scene, TheTakerOfAnOwnSetPieceIsBannedUntilAnotherTouches) {
  for (const world::Phase phase : {world::Phase::OwnKickOff, world::Phase::OwnKickIn, world::Phase::OwnCorner,
                                   world::Phase::OwnFreeKick, world::Phase::OwnDirectFreeKick}) {
    ball(0.0, 0.0);
    play(phase, 2.0);
    EXPECT_EQ(watch.banned(), 0);
    play(world::Phase::PlayOn, 0.1);
    EXPECT_EQ(watch.banned(), 9);
    ball(-0.4, -0.7);
    play(world::Phase::PlayOn, 1.0);
    EXPECT_EQ(watch.banned(), 9) << "nobody is at the ball yet";
    ball(-0.9, -0.9);
    play(world::Phase::PlayOn, 0.1);
    EXPECT_EQ(watch.banned(), 0) << "number 6 has it";
  }
}

// Otherwise a goalie and one more would stand at the ball after their kick-off until the ban runs out.
TEST_F(Scene, OfTwoWhoAreAloneTheTakerOfTheKickOffGoesOn) {
  for (const bool opponent : {false, true}) {
    world.teammates[6].known = false;
    place(world.teammates[1], -14.0, 0.0);
    world.opponents[8].known = opponent;
    play(world::Phase::OwnKickOff, 2.0);
    play(world::Phase::PlayOn, 0.1);
    EXPECT_EQ(watch.banned(), opponent ? 9 : 0) << "the rule is for more than two";
  }
}

TEST_F(Scene, AnOpponentThatTouchesEndsTheBan) {
  play(world::Phase::OwnFreeKick, 3.0);
  play(world::Phase::PlayOn, 0.2);
  ASSERT_EQ(watch.banned(), 9);
  ball(2.4, 0.1);
  play(world::Phase::PlayOn, 0.1);
  EXPECT_EQ(watch.banned(), 0);
}

TEST_F(Scene, AnOpponentThatTookThePieceBansNobody) {
  play(world::Phase::OwnKickIn, 3.0);
  ball(2.4, 0.0);
  play(world::Phase::PlayOn, 0.2);
  EXPECT_EQ(watch.banned(), 0);
}

// Play goes on when the ball leaves the area, far from the goalie.
TEST_F(Scene, WhoTookTheGoalKickIsBannedNotWhoIsNearWhenTheBallLeavesTheArea) {
  place(world.teammates[1], -14.2, 0.0);
  ball(-14.0, 0.0);
  play(world::Phase::OwnGoalKick, 3.0);
  world.ball.v_FB = Vector3(5.0, 2.0, 0.0);
  ball(-13.0, 0.4);
  play(world::Phase::OwnGoalKick, 0.2);
  // A weak one that comes to rest in the area, beside number 6, which then takes it out.
  world.ball.v_FB.setZero();
  place(world.teammates[6], -12.9, 0.6);
  play(world::Phase::OwnGoalKick, 1.0);
  place(world.teammates[6], -10.0, -3.0);
  place(world.teammates[9], -12.5, 1.0);
  ball(-13.1, 0.8);
  play(world::Phase::PlayOn, 0.1);
  EXPECT_EQ(watch.banned(), 1);
  ball(-12.6, 0.9);
  play(world::Phase::PlayOn, 0.1);
  EXPECT_EQ(watch.banned(), 0) << "number 9 has it";
}

// Server facts 4.3: with two players the taker of the kick-off may go on.
TEST_F(Scene, NobodyIsBannedInAPenaltyShootOut) {
  world.teammates[6].known = false;
  play(world::Phase::OwnKickOff, 2.0);
  play(world::Phase::PlayOn, 0.2);
  EXPECT_EQ(watch.banned(), 0);
  world.teammates[6].known = true;
  play(world::Phase::OwnKickOff, 2.0);
  play(world::Phase::PlayOn, 0.2);
  EXPECT_EQ(watch.banned(), 9);
}

TEST_F(Scene, NobodyIsBannedAfterADropBallOrTheOpponentsKick) {
  play(world::Phase::OwnKickOff, 15.0);
  world.game.ballDropped = true;
  play(world::Phase::PlayOn, 0.2);
  EXPECT_EQ(watch.banned(), 0);
  play(world::Phase::OpponentKickOff, 3.0);
  play(world::Phase::PlayOn, 0.2);
  EXPECT_EQ(watch.banned(), 0);
}

TEST_F(Scene, TheNextStopOfTheGameEndsTheBan) {
  play(world::Phase::OwnKickOff, 2.0);
  play(world::Phase::PlayOn, 0.2);
  ASSERT_EQ(watch.banned(), 9);
  play(world::Phase::OpponentKickIn, 0.1);
  EXPECT_EQ(watch.banned(), 0);
}

// Server facts 4.9: until a mate has touched the ball, too, or ten seconds are over.
TEST_F(Scene, WhoKicksInPassModeCannotScoreAloneForTenSeconds) {
  play(world::Phase::OwnPass, 2.0);
  EXPECT_EQ(watch.barred(), 0) << "nobody can score in the mode itself";
  play(world::Phase::PlayOn, 0.1);
  EXPECT_EQ(watch.barred(), 9);
  EXPECT_EQ(watch.banned(), 0) << "but may touch the ball";
  ball(2.4, 0.1);
  play(world::Phase::PlayOn, 1.0);
  EXPECT_EQ(watch.barred(), 9) << "an opponent's touch changes nothing";
  ball(-0.9, -0.9);
  play(world::Phase::PlayOn, 0.1);
  EXPECT_EQ(watch.barred(), 0) << "number 6 has it";

  ball(0.0, 0.0);
  play(world::Phase::OwnPass, 2.0);
  ball(5.0, 5.0);
  place(world.teammates[9], 4.8, 5.0);
  play(world::Phase::PlayOn, 9.9);
  EXPECT_EQ(watch.barred(), 9);
  play(world::Phase::PlayOn, 0.2);
  EXPECT_EQ(watch.barred(), 0);
}

TEST_F(Scene, ASetPieceEndsThatBan) {
  play(world::Phase::OwnPass, 2.0);
  play(world::Phase::PlayOn, 1.0);
  ASSERT_EQ(watch.barred(), 9);
  play(world::Phase::OwnKickIn, 1.0);
  play(world::Phase::PlayOn, 0.1);
  EXPECT_EQ(watch.barred(), 0);
}

}  // namespace
}  // namespace nonet::team
