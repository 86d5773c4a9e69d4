// What to do with the ball: in scenes in which the right answer is plain, and against a brute-force look at
// the ball's ways.
#include "nonet/team/ball_choice.h"

#include <cmath>

#include <gtest/gtest.h>

#include "nonet/math/angle.h"
#include "nonet/math/direction.h"
#include "nonet/math/random.h"

#include "scene.h"

namespace nonet::team {
namespace {

class Choice : public testing::Test {
 protected:
  // One stands behind the ball, facing the goal.
  void ballAt(const Vector2& place) {
    scene.stand(Pose2(place.x() - 0.3, place.y(), 0.0));
    scene.putBall(place);
  }
  void opponentAt(int unum, const Vector2& place) {
    Scene::put(scene.world.opponents[static_cast<std::size_t>(unum)], Pose2(place, kPi));
  }
  BallChoice choose() const { return chooseAction(scene.situation(Role::OnBall)); }

  Scene scene;
};

TEST_F(Choice, ShootsAtAnOpenGoal) {
  ballAt({10.5, 0.5});
  const BallChoice choice = choose();
  EXPECT_TRUE(choice.kick);
  const double atLine = 0.5 + (choice.p_FTarget.y() - 0.5) * 4.5 / (choice.p_FTarget.x() - 10.5);
  EXPECT_LT(std::abs(atLine), 0.9);
}

TEST_F(Choice, DoesNotKickWithAnOpponentAtTheBall) {
  ballAt({10.5, 0.5});
  opponentAt(4, {10.8, 0.5});
  EXPECT_FALSE(choose().kick);
}

TEST_F(Choice, DoesNotKickIntoAWall) {
  const auto kicks = [&](double wallX) {
    ballAt({10.5, 0.0});
    for (int i = 0; i < 9; ++i) opponentAt(i + 1, {wallX, -2.4 + 0.6 * i});
    return choose().kick;
  };
  EXPECT_FALSE(kicks(13.0));
  EXPECT_TRUE(kicks(8.0)) << "behind the ball they are as near to it, but bar nothing";
}

TEST_F(Choice, PassesToAMateThatStandsFreeInFront) {
  ballAt({0.0, 0.0});
  // The way ahead is barred.
  opponentAt(2, {2.0, 0.0});
  opponentAt(3, {2.5, -1.5});
  opponentAt(5, {4.0, -3.0});
  Scene::put(scene.world.teammates[6], Pose2(4.0, 4.5, 0.0));
  const BallChoice choice = choose();
  ASSERT_TRUE(choice.kick);
  EXPECT_LT((choice.p_FTarget - Vector2(4.0, 4.5)).norm(), 2.5);
}

// A kick that is to be exact takes longer, by twice what its head says; an opponent comes in between.
TEST_F(Choice, KicksThatAreToBeExactAreForThoseWhoHaveTheTime) {
  motion::KickOption exact = scene.motion.kicks.front();
  exact.name = "exact";
  exact.head.steady = 1.0;
  exact.head.longest = 14.0;
  const std::array kicks{scene.motion.kicks.front(), exact};
  scene.motion.kicks = kicks;
  ballAt({-8.0, 0.0});
  EXPECT_EQ(choose().with, "exact");
  const double plain = 0.3 / scene.parameters.choice.kickPace + 0.3 + scene.parameters.choice.setupWalk;
  const double between = plain + 0.5;
  const double reach = scene.parameters.choice.opponentReach;
  opponentAt(4, {-8.0, reach + between * scene.parameters.choice.opponentPace});
  EXPECT_EQ(choose().with, kicks[0].name);
}

TEST_F(Choice, WithoutAKickItDribbles) {
  ballAt({10.5, 0.5});
  scene.motion.kicks = {};
  EXPECT_FALSE(choose().kick);
}

// The kick carries 0.9 x 7 m: along the touch line to the mate that waits there, if nobody is sooner.
TEST_F(Choice, SetPiecesGoToWhereOneOfUsIsFirst) {
  scene.world.game.phase = world::Phase::OwnKickIn;
  ballAt({2.0, -9.9});
  Scene::put(scene.world.teammates[6], Pose2(6.5, -5.5, 0.0));
  const BallChoice free = chooseSetPiece(scene.situation(Role::OnBall));
  ASSERT_TRUE(free.kick);
  EXPECT_LT((free.p_FTarget - Vector2(6.5, -5.5)).norm(), 1.5);
  scene.world.teammates[6].known = false;
  // Wherever else a kick would end.
  for (int i = 0; i < 7; ++i)
    opponentAt(3 + i, scene.situation(Role::OnBall).ball() + 6.3 * unitVector(toRadians(30.0 * i)));
  const Vector2 receiver = scene.situation(Role::OnBall).setPlay->p_FReceiver;
  Scene::put(scene.world.teammates[7], Pose2(receiver, 0.0));
  EXPECT_FALSE(chooseSetPiece(scene.situation(Role::OnBall)).kick) << "the one next to the ball gets it";
}

// Two places that are worth about the same: what was planned stays, until the other one is clearly better.
TEST_F(Choice, ASetPieceKeepsItsPlan) {
  scene.world.game.phase = world::Phase::OwnKickIn;
  ballAt({2.0, -9.9});
  const Vector2 ball = scene.situation(Role::OnBall).ball();
  const auto aims = [&](double planned) {
    Situation s = scene.situation(Role::OnBall);
    s.planned = planned;
    return directionOf(chooseSetPiece(s).p_FTarget - ball);
  };
  const double left = toRadians(80.0);
  const double right = toRadians(40.0);
  Scene::put(scene.world.teammates[6], Pose2(ball + 6.3 * unitVector(left), 0.0));
  Scene::put(scene.world.teammates[7], Pose2(ball + 6.3 * unitVector(right), 0.0));
  EXPECT_LT(aims(left) - aims(right), 0.8);
  EXPECT_GT(aims(left) - aims(right), 0.3);
  scene.world.teammates[6].known = false;
  opponentAt(3, ball + 6.3 * unitVector(left));
  EXPECT_NEAR(aims(left), aims(right), 0.2) << "an opponent waits there now";
}

TEST_F(Choice, NoSetPieceGoesToAReceiverThatCannotComeInTime) {
  scene.world.game.phase = world::Phase::OwnKickIn;
  ballAt({2.0, -9.9});
  const Vector2 receiver = scene.situation(Role::OnBall).setPlay->p_FReceiver;
  Scene::put(scene.world.teammates[6], Pose2(6.5, -5.5, 0.0));
  Scene::put(scene.world.teammates[7], Pose2(receiver, 0.0));
  opponentAt(3, receiver + Vector2(0.6, 0.8));
  const auto worthOfReceiver = [&] {
    Candidates record;
    chooseSetPiece(scene.situation(Role::OnBall), &record);
    return record.all()[0].value;
  };
  const double there = worthOfReceiver();
  Scene::put(scene.world.teammates[7], Pose2(receiver - Vector2(5.0, 0.0), 0.0));
  EXPECT_LT(worthOfReceiver(), there - 0.02);
  EXPECT_TRUE(chooseSetPiece(scene.situation(Role::OnBall)).kick) << "to the other one";
}

// Kick-ins are indirect (server facts 4.5): over the goal line they are lost.
TEST_F(Choice, SetPiecesAreNoShots) {
  scene.world.game.phase = world::Phase::OwnFreeKick;
  ballAt({10.5, 0.0});
  EXPECT_LT(kickValue(scene.situation(Role::OnBall), 0.0, 6.3, false), 0.0);
  EXPECT_GT(kickValue(scene.situation(Role::OnBall), 0.0, 6.3), 0.9);
}

// The share of ball's ways, drawn with the stated spread, that cross the line between the posts.
TEST_F(Choice, ProbabilityOfAGoalIsThatOfTheDrawnWays) {
  Random random(4);
  for (int trial = 0; trial < 20; ++trial) {
    const Vector2 ball(random.uniform(10.0, 14.0), random.uniform(-3.0, 3.0));
    ballAt(ball);
    const Situation situation = scene.situation(Role::OnBall);
    const double straight = std::atan2(-ball.y(), 15.0 - ball.x());
    const double direction = straight + random.uniform(-0.15, 0.15);
    int goals = 0;
    constexpr int kWays = 20000;
    for (int i = 0; i < kWays; ++i) {
      const double way = direction + random.normal(0.0, scene.parameters.choice.spread);
      const double y = ball.y() + std::tan(way) * (15.0 - ball.x());
      if (std::abs(y) < 1.05) ++goals;
    }
    const double share = static_cast<double>(goals) / kWays;
    // What misses is worth next to nothing there: a goal kick.
    EXPECT_NEAR(kickValue(situation, direction, 6.3), share, 0.02 + 0.3 * (1.0 - share));
    if (share > 0.99) {
      EXPECT_GT(kickValue(situation, direction, 6.3), 0.97);
    }
    if (share < 0.01) {
      EXPECT_LT(kickValue(situation, direction, 6.3), 0.6);
    }
  }
}

TEST_F(Choice, TheWorthOfTheBallGrowsTowardsTheGoal) {
  const ChoiceParameters p;
  double last = 0.0;
  for (double x = -15.0; x <= 15.0; x += 1.0) {
    const double worth = worthOf({x, 0.0}, scene.world.field, p);
    EXPECT_GT(worth, last);
    EXPECT_LE(worth, p.worthMost);
    last = worth;
  }
}

TEST_F(Choice, WritesDownWhatItWeighed) {
  ballAt({3.0, 1.0});
  Candidates record;
  const BallChoice choice = chooseAction(scene.situation(Role::OnBall), &record);
  double most = -1.0;
  for (const Candidate& candidate : record.all()) most = std::max(most, candidate.value);
  EXPECT_GT(record.all().size(), 20U);
  EXPECT_DOUBLE_EQ(most, choice.value);
}

}  // namespace
}  // namespace nonet::team
