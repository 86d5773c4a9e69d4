#include "nonet/team/own_area.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "nonet/math/random.h"

#include "scene.h"

namespace nonet::team {
namespace {

constexpr double kMargin = 0.3;
const world::FieldGeometry kField;

// Whether sampled points of the straight way are in the area with its margin.
bool crosses(const Vector2& a, const Vector2& b) {
  constexpr int kSamples = 2000;
  for (int i = 0; i <= kSamples; ++i) {
    if (inOwnArea(kField, a + (b - a) * (static_cast<double>(i) / kSamples), kMargin - 1e-3)) return true;
  }
  return false;
}

// The shortest way by trying all orders of the two corners.
double shortestByTrial(const Vector2& a, const Vector2& b) {
  const double x = -0.5 * kField.length + kField.areaLength + kMargin;
  const double y = 0.5 * kField.areaWidth + kMargin;
  const Vector2 left(x, y);
  const Vector2 right(x, -y);
  if (!crosses(a, b)) return (b - a).norm();
  double best = std::numeric_limits<double>::infinity();
  for (const Vector2& corner : {left, right})
    if (!crosses(a, corner) && !crosses(corner, b))
      best = std::min(best, (corner - a).norm() + (b - corner).norm());
  for (const auto& [first, second] : {std::pair(left, right), std::pair(right, left)})
    if (!crosses(a, first) && !crosses(second, b))
      best = std::min(best, (first - a).norm() + (second - first).norm() + (b - second).norm());
  return best;
}

TEST(OwnArea, AWalkerGoesAroundOnTheShortestWay) {
  Random random(5);
  int around = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const auto outside = [&] {
      Vector2 place;
      do {
        place = Vector2(random.uniform(-14.9, -9.0), random.uniform(-9.0, 9.0));
      } while (inOwnArea(kField, place, kMargin));
      return place;
    };
    const Vector2 start = outside();
    const Vector2 target = outside();
    Vector2 place = start;
    double walked = 0.0;
    bool inside = false;
    for (int step = 0; step < 3000 && (target - place).norm() > 1e-9; ++step) {
      const Vector2 way = aroundOwnArea(kField, place, target, kMargin) - place;
      const double length = std::min(0.02, way.norm());
      place += length * way.normalized();
      walked += length;
      inside = inside || inOwnArea(kField, place, 0.0);
    }
    ASSERT_NEAR((target - place).norm(), 0.0, 1e-6) << "from " << start.transpose();
    EXPECT_FALSE(inside);
    EXPECT_NEAR(walked, shortestByTrial(start, target), 0.1);
    if (crosses(start, target)) ++around;
  }
  EXPECT_GT(around, 30);
}

TEST(OwnArea, ATargetInsideIsMovedToTheNearestEdge) {
  const Vector2 start(-10.0, 0.0);
  EXPECT_LT((aroundOwnArea(kField, start, {-13.5, 0.5}, kMargin) - Vector2(-12.9, 0.5)).norm(), 1e-9);
  EXPECT_LT((aroundOwnArea(kField, {-14.0, 5.0}, {-14.5, 2.9}, kMargin) - Vector2(-14.5, 3.3)).norm(), 1e-9);
  EXPECT_LT((aroundOwnArea(kField, {-14.0, 0.0}, {-12.0, 0.0}, kMargin) - Vector2(-12.0, 0.0)).norm(), 1e-9)
      << "out of the area on the straight way";
}

// With the goalie, a back and one more in the area nobody else goes there.
TEST(OwnArea, NobodyEntersAsTheFourth) {
  for (const Role role : {Role::BackLeft, Role::Stopper, Role::WingLeft}) {
    Scene scene;
    scene.putBall({-14.0, 1.0});
    Scene::put(scene.world.teammates[1], Pose2(-14.5, 0.3, 0.0));
    Scene::put(scene.world.teammates[2], Pose2(-13.8, -0.5, 0.0));
    Scene::put(scene.world.teammates[3], Pose2(-14.2, 1.2, 0.0));
    scene.stand(Pose2(-12.8, -3.5, 0.0));
    for (int cycle = 0; cycle < 600; ++cycle) {
      const Action action = scene.decideAs(role);
      const auto* walk = std::get_if<motion::WalkTo>(&action.motion);
      if (walk == nullptr) break;
      const Vector2 way = walk->target.translation;
      const Pose2 step(way.norm() > 0.02 ? Vector2(0.02 * way.normalized()) : way, 0.0);
      scene.stand(scene.world.self.X_FR * step);
      ASSERT_FALSE(inOwnArea(kField, scene.world.self.X_FR.translation)) << "role " << static_cast<int>(role);
    }
  }
}

TEST(OwnArea, TheBackEntersWhileThereIsRoom) {
  Scene scene;
  scene.putBall({-14.0, 1.0});
  Scene::put(scene.world.teammates[1], Pose2(-14.5, 0.3, 0.0));
  Scene::put(scene.world.teammates[3], Pose2(-14.2, 1.2, 0.0));
  scene.stand(Pose2(-12.5, 0.0, kPi));
  EXPECT_EQ(matesInOwnArea(scene.world), 2);
  Situation situation = scene.situation(Role::BackLeft);
  situation.onBall = 3;
  ASSERT_TRUE(inOwnArea(kField, situation.formation.positions[static_cast<std::size_t>(Role::BackLeft)]));
  const Action action = decide(situation);
  const auto* walk = std::get_if<motion::WalkTo>(&action.motion);
  ASSERT_NE(walk, nullptr);
  EXPECT_TRUE(inOwnArea(kField, scene.world.self.X_FR * walk->target.translation));
}

// Who lies in the area, the goalie, and one more that comes to play the ball are three.
TEST(OwnArea, TheBackKeepsAPlaceForTheOneOnTheBall) {
  Scene scene;
  scene.putBall({-14.0, 1.0});
  Scene::put(scene.world.teammates[1], Pose2(-14.5, 0.3, 0.0));
  Scene::put(scene.world.teammates[3], Pose2(-14.2, 1.2, 0.0));
  Scene::put(scene.world.teammates[6], Pose2(-12.9, 1.2, 0.0));
  scene.stand(Pose2(-12.5, 0.0, kPi));
  const auto enters = [&](int onBall) {
    Situation situation = scene.situation(Role::BackLeft);
    situation.onBall = onBall;
    return inOwnArea(kField, goalOf(scene, decide(situation)));
  };
  EXPECT_TRUE(enters(3)) << "who is inside plays it";
  EXPECT_FALSE(enters(6)) << "who is outside does";
}

}  // namespace
}  // namespace nonet::team
