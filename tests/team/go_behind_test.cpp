// The way behind a ball that rolls.
#include <variant>

#include <gtest/gtest.h>

#include "nonet/team/behaviors.h"

#include "scene.h"

namespace nonet::team {
namespace {

// Where the robot at the centre is led, the ball a metre ahead with this speed; robot frame, m.
Vector2 ledTo(const Vector2& speed, double ahead) {
  Scene scene;
  scene.stand(Pose2(0.0, 0.0, 0.0));
  scene.putBall({ahead, 0.0}, speed);
  Situation situation = assess(scene.world, scene.parameters, scene.motion);
  situation.play = playTowards(situation, {15.0, 0.0}, KickUse::Clear);
  const std::optional<Action> action = goBehindBall(situation);
  return std::get<motion::WalkTo>(action->motion).target.translation;
}

TEST(GoBehindBall, LeadsBehindWhereTheBallWillBe) {
  const BallHandlingParameters p;
  const Vector2 resting = ledTo({0.0, 0.0}, 1.0);
  const Vector2 rolling = ledTo({0.0, 1.0}, 1.0);
  EXPECT_NEAR(rolling.y() - resting.y(), p.circleAhead, 0.05);
  // Near by it is there sooner: after 0.2 m at the walking speed.
  const double soon = 0.2 / PaceParameters().walkSpeed;
  EXPECT_NEAR(ledTo({0.0, 1.0}, 0.2).y() - ledTo({0.0, 0.0}, 0.2).y(), soon, 0.05);
  EXPECT_EQ(ledTo({0.0, 0.9 * p.circleRolling}, 1.0), resting) << "as good as lying";
}

// Who turns with the feet at a ball of a set piece touches it, and may not touch it again.
TEST(GoBehind, LeavesRoomToTurnAtASetPiece) {
  const auto apart = [](world::Phase phase, double heading) {
    Scene scene;
    scene.world.game.phase = phase;
    scene.stand(Pose2(-0.6, 0.0, heading));
    scene.putBall({0.0, 0.0});
    Situation s = scene.situation(Role::OnBall);
    s.play = playTowards(s, {15.0, 0.0}, KickUse::Clear);
    const motion::WalkTo walk = std::get<motion::WalkTo>(goBehindBall(s).value().motion);
    return (s.world.self.X_FR * walk.target.translation).norm();
  };
  const BallHandlingParameters p;
  EXPECT_NEAR(apart(world::Phase::OwnKickIn, 1.2), p.standOff, 0.02);
  EXPECT_NEAR(apart(world::Phase::OwnKickIn, 0.0), p.behindBall, 0.02);
  EXPECT_LT(apart(world::Phase::PlayOn, 1.2), p.standOff - 0.03);
}

// Mate or opponent: past it, and not through the ball.
TEST(GoBehind, LeadsPastWhoStandsInTheWay) {
  Scene scene;
  scene.putBall({0.85, 0.0});
  const auto next = [&] {
    Situation s = scene.situation(Role::OnBall);
    s.play = playTowards(s, {15.0, 0.0}, KickUse::Never);
    return std::get<motion::WalkTo>(goBehindBall(s).value().motion).target.translation;
  };
  EXPECT_LT(std::abs(next().y()), 0.05);
  for (world::PlayerState* player : {&scene.world.teammates[7], &scene.world.opponents[7]}) {
    Scene::put(*player, Pose2(0.4, 0.05, 0.0));
    const Vector2 way = next();
    EXPECT_LT(way.y(), -0.1);
    EXPECT_GT((player->X_FP.translation - way).norm(), 0.28);
    player->known = false;
  }
}

}  // namespace
}  // namespace nonet::team
