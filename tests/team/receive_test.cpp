// Scenes of a ball that comes: whether to receive it, and where to.
#include <cmath>
#include <variant>

#include <gtest/gtest.h>

#include "nonet/team/situation_tracker.h"
#include "nonet/world/ball_law.h"

#include "scene.h"

namespace nonet::team {
namespace {

struct Coming : Scene {
  Coming() { parameters.receive.use = true; }
  std::optional<Action> act() const { return receive(situation(Role::OnBall)); }
  /// The way that the robot is asked to walk, in its own frame; zero: it stands.
  Pose2 speed() const {
    const std::optional<Action> action = act();
    if (!action) return {};
    const auto* walk = std::get_if<motion::WalkVelocity>(&action->motion);
    return walk != nullptr ? walk->velocity : Pose2();
  }
};

TEST(Receive, StandsInTheWayOfTheBall) {
  Coming scene;
  scene.putBall({2.0, 0.0}, {-3.0, 0.0});
  const std::optional<Action> action = scene.act();
  ASSERT_TRUE(action);
  EXPECT_TRUE(std::holds_alternative<motion::Stand>(action->motion));
}

TEST(Receive, GoesToTheLineAndFacesTheBall) {
  Coming scene;
  scene.putBall({2.0, 0.2}, {-3.0, 0.0});  // passes on the left
  EXPECT_GT(scene.speed().translation.y(), 0.2);
  EXPECT_NEAR(scene.speed().translation.x(), 0.0, 0.05);
  scene.putBall({2.0, -0.2}, {-3.0, 0.0});
  EXPECT_LT(scene.speed().translation.y(), -0.2);
  // From the left front: it turns there.
  scene.putBall({1.0, 1.0}, {-2.0, -2.0});
  EXPECT_GT(scene.speed().rotation, 0.5);
}

TEST(Receive, ABallAtTheFeetIsPlayed) {
  Coming scene;
  scene.putBall({0.5, 0.1}, {-1.0, 0.0});
  EXPECT_TRUE(scene.act());
  scene.putBall({0.25, 0.1}, {-1.0, 0.0});
  EXPECT_FALSE(scene.act());
}

TEST(Receive, ABallThatItCannotReachIsNotReceived) {
  Coming scene;
  scene.putBall({1.0, 1.5}, {-3.0, 0.0});  // passes 1.5 m away in a third of a second
  EXPECT_FALSE(scene.act());
  // Far enough, there is time; the place lies on the line.
  scene.parameters.receive.pace = 1.0;
  scene.putBall({6.0, 1.0}, {-8.0, 0.0});
  EXPECT_TRUE(scene.act());
  EXPECT_GT(scene.speed().translation.y(), 0.5);
}

// It flies over the robot, and is met where it comes down: oracle is the law of the ball, stepped.
TEST(Receive, ABallInTheAirIsMetWhereItComesDown) {
  Coming scene;
  scene.parameters.receive.pace = 1.5;
  scene.putBall({3.0, 0.0}, {-5.0, 0.0});
  scene.world.ball.p_FB.z() = 0.5;
  scene.world.ball.v_FB.z() = 4.0;
  world::BallMotion ball{scene.world.ball.p_FB, scene.world.ball.v_FB};
  for (double fall = 0.0; fall >= 0.0 || ball.v_FB.z() < 0.0;) {
    fall = ball.v_FB.z();
    world::stepBall(ball, kCycleTime);
  }
  ASSERT_LT(ball.p_FB.x(), -0.5);
  EXPECT_LT(scene.speed().translation.x(), 0.9 * scene.parameters.receive.gain * ball.p_FB.x());
}

// A low drive hits the legs.
TEST(Receive, StandsInTheWayOfALowFlight) {
  Coming scene;
  scene.putBall({2.0, 0.0}, {-8.0, 0.0});
  scene.world.ball.v_FB.z() = 2.5;  // rises to 0.36 m
  const std::optional<Action> action = scene.act();
  ASSERT_TRUE(action);
  EXPECT_TRUE(std::holds_alternative<motion::Stand>(action->motion));
}

TEST(Receive, OnlyABallThatComes) {
  Coming scene;
  scene.putBall({2.0, 0.0}, {3.0, 0.0});  // rolls away
  EXPECT_FALSE(scene.act());
  scene.putBall({2.0, 0.0}, {0.0, 3.0});  // across
  EXPECT_FALSE(scene.act());
  scene.putBall({2.0, 0.0});  // lies
  EXPECT_FALSE(scene.act());
  scene.putBall({2.0, 0.0}, {-1.0, 0.0});  // will rest a metre ahead
  EXPECT_FALSE(scene.act());
  scene.putBall({2.0, 0.0}, {-3.0, 0.0});
  EXPECT_TRUE(scene.act());
  scene.parameters.receive.use = false;
  EXPECT_FALSE(scene.act());
}

TEST(Receive, NotSomebodyElsesBall) {
  Coming scene;
  scene.putBall({2.0, 0.0}, {-3.0, 0.0});
  EXPECT_FALSE(receive(scene.situation(Role::Supporter)));
  scene.world.game.phase = world::Phase::OwnFreeKick;
  EXPECT_FALSE(scene.act());
}

// The faster the steering dribbler may be, the nearer the ball is to its line when they meet.
TEST(Dribble, SlowsDownForABallBesideTheLine) {
  Scene scene;
  const auto speedFor = [&](const Vector2& ball) {
    scene.putBall(ball);
    Situation situation = assess(scene.world, scene.parameters, scene.motion);
    situation.play = playTowards(situation, Vector2(ball.x() + 10.0, ball.y()), KickUse::Never);
    situation.play->keep = 0.5;
    const std::optional<Action> action = dribble(situation);
    return action ? std::get<motion::WalkVelocity>(action->motion).velocity : Pose2();
  };
  scene.parameters.dribble.footAside = 0.0;
  EXPECT_NEAR(speedFor({0.8, 0.0}).translation.x(), scene.parameters.dribble.speed, 1e-9);
  const Pose2 inLine = speedFor({0.2, 0.0});
  EXPECT_LT(inLine.translation.x(), 0.7 * scene.parameters.dribble.speed);  // soon at the ball
  EXPECT_NEAR(inLine.translation.y(), 0.0, 1e-9);
  const Pose2 left = speedFor({0.2, 0.15});
  EXPECT_LT(left.translation.x(), inLine.translation.x() - 0.05);
  EXPECT_GT(left.translation.y(), 0.1);
  const Pose2 right = speedFor({0.2, -0.15});
  EXPECT_NEAR(right.translation.x(), left.translation.x(), 1e-9);
  EXPECT_NEAR(right.translation.y(), -left.translation.y(), 1e-9);
  // With a foot that meets it there no way aside is left, and the robot faces inwards.
  scene.parameters.dribble.footAside = 0.05;
  const Pose2 byFoot = speedFor({0.2, 0.04});
  EXPECT_NEAR(byFoot.translation.y(), 0.0, 1e-9);
  EXPECT_LT(byFoot.rotation, 0.0);
  // Abreast of the ball it must go around it.
  EXPECT_EQ(speedFor({0.02, 0.1}).translation.norm(), 0.0);
}

// A drill: the ball goes where it is told, whoever's turn it is.
TEST(Drill, TheIntentTakesTheGamesPlace) {
  Scene scene;
  SituationTracker tracker(scene.parameters);
  scene.putBall({0.5, 0.0});
  tracker.setIntent(BallIntent{Vector2(0.5, 3.0), KickUse::Clear, 0.4});
  const Situation told = tracker.update(scene.world, scene.motion);
  ASSERT_TRUE(told.play);
  EXPECT_EQ(told.play->p_FTarget, Vector2(0.5, 3.0));
  EXPECT_EQ(told.play->use, KickUse::Clear);
  EXPECT_EQ(told.play->keep, 0.4);
  EXPECT_NEAR(told.play->direction, 0.5 * kPi, 1e-9);
  scene.world.ball.known = false;
  EXPECT_FALSE(tracker.update(scene.world, scene.motion).play);
}

}  // namespace
}  // namespace nonet::team
