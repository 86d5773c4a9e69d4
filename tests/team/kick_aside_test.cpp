// Kicks to the side past an opponent that stands in front of the ball. The oracle: straight lines of the
// kick's length at its angle, on a field of 30 x 20 m.
#include <array>
#include <cmath>
#include <optional>

#include <gtest/gtest.h>

#include "nonet/math/angle.h"
#include "nonet/math/direction.h"
#include "nonet/motion/kick_catalogue.h"

#include "scene.h"

namespace nonet::team {
namespace {

constexpr double kAngle = toRadians(60.0);
constexpr double kLength = 6.0;

struct Held : Scene {
  Held() {
    motion::KickOption straight;
    straight.name = "straight";
    straight.head.longest = 10.0;
    motion::KickOption left;
    left.name = "side";
    left.head.p_RBall = {0.17, 0.0};
    left.head.direction = -kAngle;
    left.head.turn = toRadians(15.0);
    left.head.longest = kLength;
    motion::KickOption right = left;
    right.foot = model::Side::Right;
    right.head = motion::mirroredHead(left.head);
    kicks = {straight, left, right};
    motion.kicks = kicks;
    parameters.aside.use = true;
    // The opponents below are placed for this reach: from farther they would turn the way of the ball too.
    parameters.target.barReach = 1.5;
    parameters.target.barWidth = 0.6;
    stand(Pose2(0.8, 0.0, 0.0));
    put(world.opponents[3], Pose2(1.35, 0.0, kPi));
  }
  // The direction of the ball that is asked for, own field frame; nothing unless the kick goes to the side.
  std::optional<double> kicked() const {
    const std::optional<Action> action = kickAside(situation(Role::OnBall));
    if (!action) return std::nullopt;
    const auto& request = std::get<motion::KickTo>(action->motion);
    EXPECT_EQ(request.kick.view(), "side");
    return directionOf(world.self.X_FR.rotate(request.target - request.ball));
  }

  std::array<motion::KickOption, 3> kicks;
};

TEST(KickAside, GoesPastWhoStandsInFrontOfTheBall) {
  const Held scene;
  const std::optional<double> direction = scene.kicked();
  ASSERT_TRUE(direction);
  EXPECT_NEAR(std::abs(*direction), kAngle, toRadians(20.0));
  EXPECT_EQ(scene.decideAs(Role::OnBall).reason.behavior, "kick aside");
}

TEST(KickAside, OnlyWhileSomebodyHoldsTheBallUp) {
  Held scene;
  Scene::put(scene.world.opponents[3], Pose2(1.0, 3.0, kPi));
  EXPECT_FALSE(scene.kicked()) << "the way is free";
  Scene::put(scene.world.opponents[3], Pose2(0.45, 0.3, 0.0));
  EXPECT_FALSE(scene.kicked()) << "the opponent is behind";
}

TEST(KickAside, ToTheSideThatIsFree) {
  for (const double side : {-1.0, 1.0}) {
    Held scene;
    // In the way on this side, for every direction that the kick can take.
    for (const int i : {0, 1, 2, 3}) {
      const Vector2 way = unitVector(side * toRadians(30.0 + 20.0 * i));
      Scene::put(scene.world.opponents[static_cast<std::size_t>(4 + i)],
                 Pose2(scene.situation(Role::OnBall).ball() + 2.0 * way, kPi));
    }
    const std::optional<double> direction = scene.kicked();
    ASSERT_TRUE(direction);
    EXPECT_LT(side * *direction, 0.0);
  }
}

TEST(KickAside, StaysInTheField) {
  for (const double side : {-1.0, 1.0}) {
    Held scene;
    const double y = side * (0.5 * scene.world.field.width - 2.0);
    scene.putBall({1.0, y});
    scene.stand(Pose2(0.8, y, 0.0));
    Scene::put(scene.world.opponents[3], Pose2(1.35, y, kPi));
    const std::optional<double> direction = scene.kicked();
    ASSERT_TRUE(direction);
    const double length = scene.parameters.aside.length * kLength + scene.parameters.aside.margin;
    EXPECT_LT(std::abs(y + length * std::sin(*direction)), 0.5 * scene.world.field.width);
  }
}

TEST(KickAside, NotToWhereOpponentsAreFirst) {
  Held scene;
  for (const int i : {0, 1, 2, 3, 4, 5}) {
    const Vector2 way = unitVector(toRadians(-100.0 + 40.0 * i));
    Scene::put(scene.world.opponents[static_cast<std::size_t>(4 + i)],
               Pose2(Vector2(Vector2(1.0, 0.0) + 5.5 * way), kPi));
  }
  EXPECT_FALSE(scene.kicked());
  // A mate nearer to where it ends makes it worth while.
  Scene::put(scene.world.teammates[7], Pose2(Vector2(1.0, 0.0) + 4.4 * unitVector(kAngle), 0.0));
  EXPECT_TRUE(scene.kicked());
}

// Pushes score there.
TEST(KickAside, NotBeforeTheGoal) {
  Held scene;
  const double x = 0.5 * scene.world.field.length - 3.0;
  scene.putBall({x, 0.0});
  scene.stand(Pose2(x - 0.2, 0.0, 0.0));
  Scene::put(scene.world.opponents[3], Pose2(x + 0.35, 0.0, kPi));
  EXPECT_FALSE(scene.kicked());
}

// Once the ball lies right for it the kick ahead does not take over.
TEST(KickAside, IsKeptInItsPlace) {
  Held scene;
  const Action first = scene.decideAs(Role::OnBall);
  ASSERT_EQ(first.reason.behavior, "kick aside");
  scene.motion.request = first.motion;
  scene.motion.kick.name = "side";
  scene.motion.kick.inPlace = true;
  const Action then = scene.decideAs(Role::OnBall);
  EXPECT_EQ(then.reason.behavior, "kick aside");
  EXPECT_EQ(then.reason.detail, "in place");
}

}  // namespace
}  // namespace nonet::team
