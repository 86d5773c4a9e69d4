// A free ball that rolls: who is to play it goes around it to the place behind where it will rest.
#include <algorithm>
#include <cmath>
#include <variant>

#include <gtest/gtest.h>

#include "nonet/math/direction.h"
#include "nonet/math/random.h"
#include "nonet/world/ball_law.h"

#include "scene.h"

namespace nonet::team {
namespace {

constexpr double kCycle = 0.02;  // s
constexpr double kPace = 1.0;    // m/s
constexpr double kFeet = 0.12;   // m before the torso they touch the ball

// How near the robot comes to the ball while it waits for it, m: it goes where it is told at an even pace.
double nearestWhileItRolls(Scene scene, const Vector2& place, const Vector2& speed) {
  world::BallMotion ball{Vector3(place.x(), place.y(), 0.0403), Vector3(speed.x(), speed.y(), 0.0)};
  double nearest = 1e9;
  for (double time = 0.0; time < 10.0; time += kCycle) {
    scene.putBall(ball.p_FB.head<2>(), ball.v_FB.head<2>());
    const std::optional<Action> action = awaitBall(scene.situation(Role::OnBall));
    if (!action) break;
    Pose2 self = scene.world.self.X_FR;
    nearest = std::min(nearest, (self.translation - scene.world.ball.p_FB.head<2>()).norm());
    const Vector2 way = goalOf(scene, *action) - self.translation;
    self.translation += std::min(kPace * kCycle, way.norm()) * way.normalized();
    scene.stand(self);
    world::moveBall(ball, kCycle);
  }
  return nearest;
}

// It stands between the ball and the opponents' goal, and the ball rolls away from there: straight to the
// place behind it the robot would run into it.
TEST(AwaitBall, GoesAroundTheBallThatItOvertakes) {
  Random random(5);
  int through = 0;
  for (int i = 0; i < 100; ++i) {
    Scene scene;
    scene.stand(
        Pose2(Vector2(random.uniform(0.0, 4.0), random.uniform(-3.0, 3.0)), random.uniform(-kPi, kPi)));
    const Vector2 self = scene.world.self.X_FR.translation;
    const Vector2 away = unitVector(random.uniform(0.8, 1.2) * kPi);
    const Vector2 ball = self + random.uniform(0.4, 1.0) * away;
    const Vector2 speed = random.uniform(0.6, 1.2) * away;
    EXPECT_GT(nearestWhileItRolls(scene, ball, speed), kFeet) << "scene " << i;
    scene.parameters.ball.awaitRoom = 0.0;
    through += nearestWhileItRolls(scene, ball, speed) < kFeet ? 1 : 0;
  }
  EXPECT_GT(through, 20);  // otherwise these scenes show nothing
}

}  // namespace
}  // namespace nonet::team
