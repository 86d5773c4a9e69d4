// Waiting for a ball that rolls, with nobody near: where one goes to.
#include <variant>

#include <gtest/gtest.h>

#include "nonet/team/behaviors.h"

#include "scene.h"

namespace nonet::team {
namespace {

// Where the robot goes, own field frame; the ball rolls along x from the centre with 1.5 m/s.
Vector2 goesTo(const Pose2& X_FR, const Vector2& p_FTarget) {
  Scene scene;
  scene.stand(X_FR);
  scene.putBall({0.0, 0.0}, {1.5, 0.0});
  Situation situation = assess(scene.world, scene.parameters, scene.motion);
  situation.role = Role::OnBall;
  situation.play = playTowards(situation, p_FTarget, KickUse::Clear);
  const std::optional<Action> action = awaitBall(situation);
  if (!action) {
    ADD_FAILURE() << "it does not wait";
    return Vector2::Zero();
  }
  return X_FR * std::get<motion::WalkTo>(action->motion).target.translation;
}

TEST(AwaitBall, WhoFollowsItsOwnBallStaysInLine) {
  EXPECT_NEAR(goesTo(Pose2(-0.6, 0.02, 0.0), {15.0, 0.0}).y(), 0.0, 0.05);
}

TEST(AwaitBall, WhoStandsAheadOfTheBallKeepsOutOfItsWay) {
  const double room = Scene().parameters.ball.awaitAside;
  EXPECT_GT(goesTo(Pose2(2.0, 0.1, kPi), {15.0, 0.0}).y(), 0.5 * room);
  EXPECT_LT(goesTo(Pose2(2.0, -0.1, kPi), {15.0, 0.0}).y(), -0.5 * room);
}

}  // namespace
}  // namespace nonet::team
