// When the goalkeeper dives and when it goes to the ball: a dive costs the time of rising, so everything that
// a dive does not change must not cause one.
#include <gtest/gtest.h>

#include "scene.h"

namespace nonet::team {
namespace {

Scene goalieScene(const Vector2& ball, const Vector2& speed) {
  Scene scene;
  scene.world.game.unum = 1;
  scene.stand(Pose2(-14.4, 0.0, 0.0));
  scene.putBall(ball, speed);
  return scene;
}

bool dives(const Vector2& place, const Vector2& speed) {
  const Action action = goalieScene(place, speed).decideAs(Role::Goalie);
  EXPECT_EQ(action.reason.behavior == "dive", std::holds_alternative<motion::PlaySkill>(action.motion));
  return action.reason.behavior == "dive";
}

TEST(Goalie, DivesForAShotBesideIt) {
  for (const double side : {1.0, -1.0}) {
    const Action action = goalieScene({-12.5, side * 0.7}, {-4.0, 0.0}).decideAs(Role::Goalie);
    ASSERT_TRUE(std::holds_alternative<motion::PlaySkill>(action.motion));
    EXPECT_EQ(std::get<motion::PlaySkill>(action.motion).side,
              side > 0.0 ? model::Side::Left : model::Side::Right);
  }
}

TEST(Goalie, DoesNotDiveWhereThatChangesNothing) {
  EXPECT_FALSE(dives({-12.5, 0.05}, {-4.0, 0.0})) << "straight at it";
  EXPECT_FALSE(dives({-12.5, 2.0}, {-4.0, 0.0})) << "wide of the goal";
  EXPECT_FALSE(dives({-10.0, 0.7}, {-2.0, 0.0})) << "stops on the way: 2 m/s roll 1.9 m";
  EXPECT_FALSE(dives({-8.0, 0.7}, {-8.0, 0.0})) << "seconds away: it can still step aside";
  EXPECT_FALSE(dives({-12.5, 0.7}, {4.0, 0.0})) << "going away";
}

TEST(Goalie, ClaimsABallNearTheGoalUnlessAMateIsSooner) {
  Scene scene = goalieScene({-13.5, 0.8}, {0.0, 0.0});
  EXPECT_TRUE(scene.situation(Role::Goalie).claims);
  EXPECT_EQ(scene.decideAs(Role::Goalie).reason.behavior, "go to ball");
  Scene::put(scene.world.teammates[3], Pose2(-13.7, 0.8, 0.0));
  EXPECT_FALSE(scene.situation(Role::Goalie).claims);
  EXPECT_EQ(scene.decideAs(Role::Goalie).reason.behavior, "guard goal");
}

TEST(Goalie, KeepsItsClaimInALargerRegion) {
  const TeamParameters parameters;
  const double attack = parameters.goalie.attackDistance;
  for (const auto& [distance, first, again] :
       {std::tuple{0.9 * attack, true, true}, {1.2 * attack, false, true}, {1.5 * attack, false, false}}) {
    const Scene scene = goalieScene({-15.0 + distance, 0.0}, {0.0, 0.0});
    const Situation situation = scene.situation(Role::Goalie);
    EXPECT_EQ(goalieWantsBall(situation, false), first) << distance;
    EXPECT_EQ(goalieWantsBall(situation, true), again) << distance;
  }
}

TEST(Goalie, StaysBetweenBallAndGoal) {
  for (const double y : {-6.0, 0.0, 6.0}) {
    const Scene scene = goalieScene({-5.0, y}, {0.0, 0.0});
    const Action action = scene.decideAs(Role::Goalie);
    EXPECT_EQ(action.reason.behavior, "guard goal");
    const Vector2 place = goalOf(scene, action);
    EXPECT_NEAR((place - Vector2(-15.0, 0.0)).norm(), 0.6, 0.15);
    EXPECT_GE(place.y() * y, 0.0);
  }
}

}  // namespace
}  // namespace nonet::team
