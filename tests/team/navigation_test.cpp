// Point robots that follow the requests at walking speed, in fuzzed scenes: they arrive, and pass the others
// at a distance at which walking robots do not touch.
#include "nonet/team/navigation.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "nonet/math/random.h"

namespace nonet::team {
namespace {

using motion::MotionRequest;

constexpr double kSpeed = 0.7;      // m/s
constexpr double kTurnSpeed = 1.5;  // rad/s
constexpr double kGain = 3.0;       // Hz, slows the walk down near a target at which it stops

void follow(const MotionRequest& request, Pose2& X_FR) {
  const auto* walk = std::get_if<motion::WalkTo>(&request);
  if (walk == nullptr) return;
  const double distance = walk->target.translation.norm();
  double speed = kSpeed;
  if (walk->stopAtTarget) speed = std::min(speed, kGain * distance);
  const double step = std::min(speed * kCycleTime, distance);
  const Vector2 move =
      distance > 1e-9 ? Vector2(walk->target.translation * (step / distance)) : Vector2::Zero();
  const double most = kTurnSpeed * kCycleTime;
  X_FR = X_FR * Pose2(move, std::clamp(walk->target.rotation, -most, most));
}

void put(world::PlayerState& player, const Vector2& place) {
  player.known = true;
  player.X_FP = Pose2(place, 0.0);
}

TEST(Navigation, ArrivesAndKeepsClearOfStandingRobots) {
  Random random(9);
  int arrived = 0;
  int near = 0;
  const int trials = 200;
  for (int trial = 0; trial < trials; ++trial) {
    world::WorldState world;
    world.game.unum = 2;
    world.self.X_FR = Pose2(-5.0, 0.0, random.uniform(-kPi, kPi));
    const Pose2 target(5.0, random.uniform(-2.0, 2.0), random.uniform(-kPi, kPi));
    std::vector<Vector2> others;
    while (others.size() < 5) {
      const Vector2 place(random.uniform(-3.8, 3.8), random.uniform(-2.0, 2.0));
      const bool apart = std::none_of(others.begin(), others.end(),
                                      [&](const Vector2& other) { return (other - place).norm() < 1.0; });
      if (apart) others.push_back(place);
    }
    for (std::size_t i = 0; i < others.size(); ++i) put(world.opponents[i + 1], others[i]);
    double closest = 10.0;
    bool there = false;
    for (int cycle = 0; cycle < 2000 && !there; ++cycle) {
      const MotionRequest request = walkTo(world, {}, target, {});
      there = std::holds_alternative<motion::Stand>(request);
      follow(request, world.self.X_FR);
      for (const Vector2& other : others)
        closest = std::min(closest, (other - world.self.X_FR.translation).norm());
    }
    const double left = (world.self.X_FR.translation - target.translation).norm();
    if (there && left < 0.13) ++arrived;
    if (closest < 0.5) ++near;
  }
  EXPECT_GE(arrived, trials * 98 / 100) << arrived << " of " << trials;
  EXPECT_LE(near, trials * 2 / 100) << near << " of " << trials << " came near";
}

TEST(Navigation, TwoThatMeetPassEachOther) {
  Random random(10);
  const int trials = 100;
  int good = 0;
  for (int trial = 0; trial < trials; ++trial) {
    std::array<world::WorldState, 2> worlds;
    const Pose2 start(-2.0, random.uniform(-0.3, 0.3), 0.0);
    worlds[0].self.X_FR = start;
    worlds[1].self.X_FR = Pose2(2.0, random.uniform(-0.3, 0.3), kPi);
    worlds[0].game.unum = 2;
    worlds[1].game.unum = 3;
    const std::array<Pose2, 2> targets = {Pose2(2.0, 0.0, 0.0), Pose2(-2.0, 0.0, kPi)};
    double closest = 10.0;
    for (int cycle = 0; cycle < 1000; ++cycle) {
      std::array<Pose2, 2> now = {worlds[0].self.X_FR, worlds[1].self.X_FR};
      for (std::size_t i = 0; i < 2; ++i) {
        world::PlayerState& other = worlds[i].teammates[3 - i];
        put(other, now[1 - i].translation);
        follow(walkTo(worlds[i], {}, targets[i], {}), worlds[i].self.X_FR);
      }
      closest = std::min(closest, (worlds[0].self.X_FR.translation - worlds[1].self.X_FR.translation).norm());
    }
    const bool arrived = (worlds[0].self.X_FR.translation - targets[0].translation).norm() < 0.2 &&
                         (worlds[1].self.X_FR.translation - targets[1].translation).norm() < 0.2;
    if (arrived && closest > 0.45) ++good;
  }
  EXPECT_GE(good, trials * 98 / 100) << good << " of " << trials;
}

TEST(Navigation, KeepsOffTheBallAndThePlayerOnIt) {
  world::WorldState world;
  world.game.unum = 2;
  world.ball.known = true;
  world.ball.p_FB = Vector3(0.0, 0.0, 0.04);
  put(world.teammates[5], Vector2(-0.2, 0.0));
  world.self.X_FR = Pose2(-3.0, 0.1, 0.0);
  Caution caution;
  caution.ball = 0.7;
  caution.onBall = 5;
  caution.onBallRoom = 1.2;
  double toBall = 10.0;
  double toMate = 10.0;
  for (int cycle = 0; cycle < 1000; ++cycle) {
    follow(walkTo(world, {}, Pose2(3.0, 0.0, 0.0), caution), world.self.X_FR);
    toBall = std::min(toBall, world.self.X_FR.translation.norm());
    toMate = std::min(toMate, (world.self.X_FR.translation - Vector2(-0.2, 0.0)).norm());
  }
  EXPECT_GT(toBall, 0.6);
  EXPECT_GT(toMate, 1.0);
  EXPECT_NEAR(world.self.X_FR.translation.x(), 3.0, 0.2);
}

TEST(Navigation, WalksStraightThroughWhereSomebodyMayBe) {
  world::WorldState world;
  world.game.unum = 2;
  put(world.opponents[5], Vector2(1.0, 0.0));
  Caution caution;
  caution.robots = 0.7;
  const auto aside = [&](double sigma) {
    world.opponents[5].sigma = sigma;
    const auto request = walkTo(world, {}, Pose2(2.0, 0.0, 0.0), caution);
    return std::abs(std::get<motion::WalkTo>(request).target.translation.y());
  };
  EXPECT_GT(aside(0.3), 0.3);
  EXPECT_LT(aside(2.0), 0.01) << "unseen for seconds";
}

TEST(Navigation, WaitsAtTheEdgeOfAPlaceThatIsTaken) {
  world::WorldState world;
  world.game.unum = 2;
  put(world.teammates[5], Vector2(2.0, 0.0));
  world.self.X_FR = Pose2(-1.0, 0.3, 0.0);
  Caution caution;
  caution.robots = 0.7;
  for (int cycle = 0; cycle < 500; ++cycle)
    follow(walkTo(world, {}, Pose2(2.0, 0.0, 0.0), caution), world.self.X_FR);
  const Pose2 settled = world.self.X_FR;
  for (int cycle = 0; cycle < 200; ++cycle)
    follow(walkTo(world, {}, Pose2(2.0, 0.0, 0.0), caution), world.self.X_FR);
  EXPECT_NEAR((settled.translation - Vector2(2.0, 0.0)).norm(), 0.7, 0.15);
  EXPECT_LT((world.self.X_FR.translation - settled.translation).norm(), 0.05) << "it stands still";
}

}  // namespace
}  // namespace nonet::team
