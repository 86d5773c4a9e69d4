// When the goalkeeper dives and when it goes to the ball: a dive costs the time of rising, so everything that
// a dive does not change must not cause one.
#include "nonet/team/goalie.h"

#include <gtest/gtest.h>

#include "nonet/team/ball_handling.h"

namespace nonet::team {
namespace {

using motion::MotionRequest;

world::WorldState scene() {
  world::WorldState world;
  world.game.unum = 1;
  world.game.phase = world::Phase::PlayOn;
  world.self.localized = true;
  world.self.X_FR = Pose2(-14.4, 0.0, 0.0);
  world.ball.known = true;
  return world;
}

void setBall(world::WorldState& world, const Vector2& place, const Vector2& speed) {
  world.ball.p_FB = Vector3(place.x(), place.y(), 0.0403);
  world.ball.v_FB = Vector3(speed.x(), speed.y(), 0.0);
  world.ball.p_RB = world.self.X_FR.inverse() * place;
}

bool dives(const Vector2& place, const Vector2& speed) {
  world::WorldState world = scene();
  setBall(world, place, speed);
  Goalie goalie{TeamParameters{}};
  return std::holds_alternative<motion::PlaySkill>(goalie.update(world, true));
}

TEST(Goalie, DivesForAShotBesideIt) {
  world::WorldState world = scene();
  setBall(world, {-12.5, 0.7}, {-4.0, 0.0});
  Goalie goalie{TeamParameters{}};
  const MotionRequest request = goalie.update(world, true);
  ASSERT_TRUE(std::holds_alternative<motion::PlaySkill>(request));
  EXPECT_EQ(std::get<motion::PlaySkill>(request).side, model::Side::Left);
}

TEST(Goalie, DoesNotDiveWhereThatChangesNothing) {
  EXPECT_FALSE(dives({-12.5, 0.05}, {-4.0, 0.0})) << "straight at it";
  EXPECT_FALSE(dives({-12.5, 2.0}, {-4.0, 0.0})) << "wide of the goal";
  EXPECT_FALSE(dives({-10.0, 0.7}, {-2.0, 0.0})) << "stops on the way: 2 m/s roll 1.9 m";
  EXPECT_FALSE(dives({-8.0, 0.7}, {-8.0, 0.0})) << "seconds away: it can still step aside";
  EXPECT_FALSE(dives({-12.5, 0.7}, {4.0, 0.0})) << "going away";
}

TEST(Goalie, ClaimsABallNearTheGoalUnlessAMateIsSooner) {
  world::WorldState world = scene();
  setBall(world, {-13.5, 0.8}, {0.0, 0.0});
  Goalie goalie{TeamParameters{}};
  goalie.update(world, true);
  EXPECT_TRUE(goalie.claimsBall());
  world.teammates[3].known = true;
  world.teammates[3].X_FP = Pose2(-13.7, 0.8, 0.0);
  Goalie other{TeamParameters{}};
  other.update(world, true);
  EXPECT_FALSE(other.claimsBall());
  other.update(world, false);
  EXPECT_FALSE(other.claimsBall());
}

TEST(Goalie, StaysBetweenBallAndGoal) {
  world::WorldState world = scene();
  for (const double y : {-6.0, 0.0, 6.0}) {
    setBall(world, {-5.0, y}, {0.0, 0.0});
    Goalie goalie{TeamParameters{}};
    const MotionRequest request = goalie.update(world, true);
    EXPECT_FALSE(goalie.claimsBall());
    const auto* walk = std::get_if<motion::WalkTo>(&request);
    const Vector2 place = world.self.X_FR * (walk != nullptr ? walk->target.translation : Vector2(0.0, 0.0));
    EXPECT_NEAR((place - Vector2(-15.0, 0.0)).norm(), 0.6, 0.15);
    EXPECT_GE(place.y() * y, 0.0);
  }
}

}  // namespace
}  // namespace nonet::team
