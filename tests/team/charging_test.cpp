// Who would run into an opponent slows down, unless the referee lets it pass.
#include "nonet/team/charging.h"

#include <cmath>

#include <gtest/gtest.h>

#include "scene.h"

namespace nonet::team {
namespace {

// One stands at (0, 0) and walks straight on, x metres at most; its speed as it is asked for then, m/s.
// Infinite: as fast as it can.
double speedTowards(const Scene& scene, double rotation = 0.0) {
  const motion::MotionRequest fast = motion::WalkTo{Pose2(1.0, 0.0, rotation), false};
  const auto slowly = spareOpponents(scene.situation(Role::OnBall), fast);
  if (!slowly) return std::numeric_limits<double>::infinity();
  return std::get<motion::WalkVelocity>(*slowly).velocity.translation.norm();
}

Scene sceneWith(const Vector2& ball, const Vector2& opponent) {
  Scene scene;
  scene.putBall(ball);
  Scene::put(scene.world.opponents[4], Pose2(opponent, kPi));
  return scene;
}

TEST(Charging, SlowsDownBeforeAnOpponentThatIsNearerToTheBall) {
  EXPECT_NEAR(speedTowards(sceneWith({0.6, 0.0}, {0.36, 0.1})), TeamParameters{}.charging.speed, 1e-9);
  EXPECT_LT(TeamParameters{}.charging.speed, 0.4) << "server facts 4.10: fouls begin there";
}

// Braking evenly: the square of the speed falls by twice the brake with each metre, to that of the contact.
TEST(Charging, BrakesEvenlyUntilTheContact) {
  const ChargingParameters& p = TeamParameters{}.charging;
  const auto speedAt = [](double x) { return speedTowards(sceneWith({x + 0.2, 0.0}, {x, 0.0})); };
  constexpr double kStep = 0.01;  // m
  double nearer = speedAt(0.4);
  EXPECT_GT(nearer, p.speed);
  EXPECT_LT(nearer, p.speed + 0.1);
  for (double x = 0.4 + kStep; x < p.reach; x += kStep) {
    const double speed = speedAt(x);
    EXPECT_NEAR((speed * speed - nearer * nearer) / kStep, 2.0 * p.brake, 1e-6);
    nearer = speed;
  }
}

TEST(Charging, RunsOnWhenTheRefereeLetsItPass) {
  EXPECT_TRUE(std::isinf(speedTowards(sceneWith({1.5, 0.0}, {0.9, 0.0})))) << "it is far";
  EXPECT_TRUE(std::isinf(speedTowards(sceneWith({0.3, 0.0}, {0.45, 0.3})))) << "the ball is nearer to us";
  EXPECT_TRUE(std::isinf(speedTowards(sceneWith({0.12, 0.0}, {0.3, 0.0})))) << "we are at the ball";
  EXPECT_TRUE(std::isinf(speedTowards(sceneWith({-1.0, 0.0}, {-0.4, 0.0})))) << "the way leads elsewhere";
  Scene fallen = sceneWith({0.6, 0.0}, {0.45, 0.1});
  fallen.world.opponents[4].fallen = true;
  EXPECT_TRUE(std::isinf(speedTowards(fallen)));
  Scene off = sceneWith({0.6, 0.0}, {0.45, 0.1});
  off.parameters.charging.speed = 0.0;
  EXPECT_TRUE(std::isinf(speedTowards(off)));
}

// Towards the opponent rather than to the ball: that is a charge also for the one who is nearer to it.
TEST(Charging, SlowsDownWhereTheWayLeadsToTheOpponentRatherThanTheBall) {
  EXPECT_FALSE(std::isinf(speedTowards(sceneWith({0.1, 0.4}, {0.45, 0.0}))));
}

// Far from the ball any contact is a foul, and none wins anything.
TEST(Charging, KeepsOffOpponentsFarFromTheBall) {
  const ChargingParameters& p = TeamParameters{}.charging;
  const auto speed = [](const Vector2& opponent, double sigma, const Vector2& moves = {1.0, 0.0}) {
    Scene scene = sceneWith({-4.0, 0.0}, opponent);
    scene.parameters.charging.reach = 0.0;  // the rules of the duel do not count here
    scene.world.opponents[4].sigma = sigma;
    scene.world.teammates[5].v_FP = moves;
    return speedTowards(scene);
  };
  EXPECT_NEAR(speed({0.5, 0.0}, 0.02), p.offBallSpeed, 1e-9);
  EXPECT_LT(p.offBallSpeed, 0.4) << "server facts 4.10: fouls begin at 0.4";
  EXPECT_TRUE(std::isinf(speed({0.8, 0.0}, 0.02)));
  EXPECT_NEAR(speed({0.8, 0.0}, 0.15), p.offBallSpeed, 1e-9) << "it may be nearer";
  EXPECT_TRUE(std::isinf(speed({2.0, 0.0}, 3.0))) << "it may be anywhere";
  EXPECT_TRUE(std::isinf(speed({-0.4, 0.1}, 0.02))) << "behind";
  EXPECT_NEAR(speed({-0.4, 0.1}, 0.02, {-1.0, 0.0}), p.offBallSpeed, 1e-9) << "the body still moves there";
  Scene near = sceneWith({0.9, 0.0}, {0.4, 0.45});
  near.world.teammates[5].v_FP = {1.0, 0.0};
  EXPECT_TRUE(std::isinf(speedTowards(near))) << "at the ball the rules of the duel count";
}

TEST(Charging, ComesNoFasterToAPlaceThanItWouldAnyway) {
  const Scene scene = sceneWith({0.6, 0.0}, {0.36, 0.1});
  const auto speed = [&](double left, bool stops) {
    const auto slowly =
        spareOpponents(scene.situation(Role::OnBall), motion::WalkTo{Pose2(left, 0.0, 0.0), stops});
    return std::get<motion::WalkVelocity>(slowly.value()).velocity.translation.x();
  };
  EXPECT_LT(speed(0.05, true), 0.1);
  EXPECT_NEAR(speed(0.05, false), TeamParameters{}.charging.speed, 1e-9);
  EXPECT_NEAR(speed(0.4, true), TeamParameters{}.charging.speed, 1e-9);
}

TEST(Charging, StillTurnsWhereTheWayTurns) {
  const Scene scene = sceneWith({0.6, 0.0}, {0.45, 0.1});
  const auto slowly =
      spareOpponents(scene.situation(Role::OnBall), motion::WalkTo{Pose2(1.0, 0.0, 0.2), false});
  ASSERT_TRUE(slowly);
  EXPECT_GT(std::get<motion::WalkVelocity>(*slowly).velocity.rotation, 0.1);
}

TEST(Charging, RunsOnBesideAnOpponent) {
  const double aside = TeamParameters{}.charging.aside;
  EXPECT_FALSE(std::isinf(speedTowards(sceneWith({0.8, 0.0}, {0.3, aside - 0.02}))));
  EXPECT_TRUE(std::isinf(speedTowards(sceneWith({0.8, 0.0}, {0.3, aside + 0.02}))));
}

// Server facts 4.10: the goalie is let go in its own area only.
TEST(Charging, TheGoalieSlowsDownOutsideOfItsArea) {
  const auto slows = [](double x) {
    Scene scene;
    scene.world.game.unum = 1;
    scene.stand(Pose2(x, 0.0, 0.0));
    scene.putBall({x + 0.6, 0.0});
    Scene::put(scene.world.opponents[4], Pose2(x + 0.45, 0.1, kPi));
    return spareOpponents(scene.situation(Role::Goalie), motion::WalkTo{Pose2(1.0, 0.0, 0.0), false})
        .has_value();
  };
  EXPECT_FALSE(slows(-14.0));
  EXPECT_TRUE(slows(-12.5));
}

}  // namespace
}  // namespace nonet::team
