// The plans for set pieces, for balls wherever the server can put them (server facts 4.7).
#include "nonet/team/set_play.h"

#include <cmath>

#include <gtest/gtest.h>

namespace nonet::team {
namespace {

void expectPlayable(world::Phase phase, const Vector2& ball) {
  const world::FieldGeometry field;
  const SetPlay play = setPlayFor(phase, ball, field, {});
  const Vector2 receiver = play.p_FReceiver;
  EXPECT_LT(std::abs(receiver.x()), 0.5 * field.length);
  EXPECT_LT(std::abs(receiver.y()), 0.5 * field.width);
  // As far as the kick goes that goes as far as it is asked to.
  const Vector2 rest = play.p_FTarget;
  EXPECT_GT((rest - ball).norm(), 2.0);
  EXPECT_LT((rest - ball).norm(), 6.0);
  // It ends in the field, and before the receiver's feet rather than at its back.
  EXPECT_LT(std::abs(rest.y()), 0.5 * field.width);
  EXPECT_LT(std::abs(rest.x()), 14.5);
  EXPECT_LT((rest - receiver).norm(), 0.6);
  EXPECT_LE(receiver.x(), rest.x() + 1e-9);
}

TEST(SetPlay, TheReceiverStandsWhereTheBallGoes) {
  for (const double side : {-1.0, 1.0}) {
    for (double x = -14.0; x <= 14.0; x += 1.0) expectPlayable(world::Phase::OwnKickIn, {x, side * 9.958});
    expectPlayable(world::Phase::OwnCorner, {14.958, side * 5.483});
    expectPlayable(world::Phase::OwnGoalKick, {-14.0, 0.0});
    for (double x = -13.0; x <= 13.0; x += 1.0)
      for (const double y : {0.0, 1.0, 3.0, 6.0}) expectPlayable(world::Phase::OwnFreeKick, {x, side * y});
    expectPlayable(world::Phase::OwnFreeKick, {13.2, side * 3.0});
  }
}

// The pass of a kick-in beside a corner rolls along the goal line rather than over it.
TEST(SetPlay, AKickInStaysInTheFieldBesideTheCornerToo) {
  for (double x = 12.0; x <= 14.95; x += 0.05) {
    const Vector2 ball(x, 9.958);
    const SetPlay play = setPlayFor(world::Phase::OwnKickIn, ball, {}, {});
    EXPECT_LT(play.p_FTarget.x(), 15.0) << x;
    EXPECT_LT(play.p_FTarget.y(), 8.5) << x;
    EXPECT_LT(play.p_FReceiver.x(), 15.0) << x;
  }
}

TEST(SetPlay, TheReceiverOfAGoalKickDoesNotChangeSidesWithTheNoise) {
  const auto receiver = [](double y) {
    return setPlayFor(world::Phase::OwnGoalKick, {-14.0, y}, {}, {}).p_FReceiver;
  };
  EXPECT_LT((receiver(0.01) - receiver(-0.01)).norm(), 0.03);
}

TEST(SetPlay, TheKickOffPassStaysInTheOwnHalfAndComesToRestBeforeTheReceiver) {
  const SetPlay play = setPlayFor(world::Phase::OwnKickOff, {0.0, 0.0}, {}, {});
  EXPECT_LT(play.p_FTarget.x(), 0.0);
  const Vector2 ahead = play.p_FTarget - play.p_FReceiver;
  EXPECT_GT(ahead.x(), 0.3);
  EXPECT_LT(ahead.x(), 0.6);
  EXPECT_NEAR(ahead.y(), 0.0, 1e-9);
  // Nor can opponents wait for it there: they are kept in their half.
  EXPECT_LT(play.p_FReceiver.x(), -1.0);
  EXPECT_LT(play.p_FTarget.x(), -1.0);
}

// Opponents that keep their distance stand in the way to the goal.
TEST(SetPlay, FreeKicksGoPastWhoStandsBeforeTheGoal) {
  for (const double y : {-6.0, -3.0, 0.0, 3.0, 6.0}) {
    for (double x = -13.0; x <= 13.0; x += 1.0) {
      const Vector2 ball(x, y);
      const Vector2 blocker = ball + 2.3 * (Vector2(15.0, 0.0) - ball).normalized();
      const SetPlay play = setPlayFor(world::Phase::OwnFreeKick, ball, {}, {});
      EXPECT_GT((play.p_FTarget - blocker).norm(), 1.0) << ball.transpose();
      EXPECT_GT((play.p_FReceiver - blocker).norm(), 1.0) << ball.transpose();
    }
  }
}

}  // namespace
}  // namespace nonet::team
