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
  EXPECT_LT((rest - receiver).norm(), 0.6);
  EXPECT_LE(receiver.x(), rest.x() + 1e-9);
}

TEST(SetPlay, TheReceiverStandsWhereTheBallGoes) {
  for (const double side : {-1.0, 1.0}) {
    for (double x = -14.0; x <= 14.0; x += 1.0) expectPlayable(world::Phase::OwnKickIn, {x, side * 9.958});
    expectPlayable(world::Phase::OwnCorner, {14.958, side * 5.483});
    expectPlayable(world::Phase::OwnGoalKick, {-14.0, 0.0});
    for (double x = -13.0; x <= 12.0; x += 1.0) expectPlayable(world::Phase::OwnFreeKick, {x, side * 6.0});
  }
}

// The push of a kick-in beside a corner rolls along the goal line rather than over it.
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
  // The opponents set off 2 m from the ball when it is kicked, which takes it some 2 s.
  EXPECT_GT(play.p_FTarget.norm(), 2.0);
}

}  // namespace
}  // namespace nonet::team
