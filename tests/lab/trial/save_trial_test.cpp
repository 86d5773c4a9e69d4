// Shots at the goalie: what counts as one is checked against closed form and against the complete simulation.
#include "nonet/lab/trial/save_trial.h"

#include <cmath>

#include <gtest/gtest.h>

#include "nonet/agent/agent_setup.h"
#include "nonet/lab/trial/game_trial.h"
#include "nonet/math/angle.h"

namespace nonet::lab {
namespace {

constexpr double kRadius = 0.042;
constexpr double kClear = 0.062;  // m, a flying ball begins above the ground

Shot shotFrom(const Vector2& place, const Vector3& velocity) {
  const bool flies = velocity.z() > 0.0;
  return {flies ? ShotKind::Flying : ShotKind::Rolling,
          {place.x(), place.y(), flies ? kClear : kRadius},
          velocity};
}

agent::AgentSettings goalieOfType(int type) {
  agent::AgentChoice choice;
  choice.robotType = type;
  return agent::makeAgentSettings(choice, NONET_SOURCE_DIR);
}

// Server facts 3.5: a ball that is set rolling at v0 without spin comes to rest after 0.677 s * v0, and rolls
// with v' = -1.062/s v.
TEST(FreeCrossing, OfARollAgreesWithItsLaw) {
  for (const double distance : {2.0, 3.0, 4.5}) {
    for (const double speed : {2.5, 5.0, 7.0, 9.0}) {
      const auto crossing = freeCrossing(shotFrom({-15.0 + distance, 0.6}, {-speed, 0.0, 0.0}));
      const double left = 0.677 * speed - distance;
      ASSERT_EQ(crossing.has_value(), left > 0.0) << distance << ' ' << speed;
      if (!crossing) continue;
      EXPECT_NEAR(crossing->speed, 1.062 * left, 0.1);
      EXPECT_NEAR(crossing->y, 0.6, 1e-3);
      EXPECT_NEAR(crossing->height, 0.0403, 0.003);
    }
  }
}

// Before its first bounce: v' = -k v - g with k = 0.01 / 0.026 (server facts 2.5, 3.3).
TEST(FreeCrossing, OfAFlightAgreesWithItsLaw) {
  const double k = 0.01 / 0.026;
  for (const double rise : {20.0, 35.0}) {
    const double level = 11.0 * std::cos(toRadians(rise));
    const double up = 11.0 * std::sin(toRadians(rise));
    const auto crossing = freeCrossing(shotFrom({-10.0, 0.0}, {-level, 0.0, up}));
    ASSERT_TRUE(crossing);
    const double time = -std::log(1.0 - 5.0 * k / level) / k;
    const double fall = (1.0 - std::exp(-k * time)) / k;
    EXPECT_NEAR(crossing->time, time, 0.02);
    EXPECT_NEAR(crossing->height, kClear + (up + 9.81 / k) * fall - 9.81 / k * time, 0.12);
  }
}

TEST(FreeCrossing, CountsOnlyWhatIsWorthASave) {
  EXPECT_TRUE(countsAsShot({0.5, 0.9, 0.04, 2.0}));
  EXPECT_FALSE(countsAsShot({0.5, 1.03, 0.04, 2.0})) << "touches the post";
  EXPECT_FALSE(countsAsShot({0.5, 0.0, 0.76, 9.0})) << "too high";
  EXPECT_FALSE(countsAsShot({0.5, 0.0, 0.04, 1.4})) << "too slow";
}

TEST(Shots, AreDrawnWithinTheirRangesAndAreGoalsWithoutAGoalie) {
  Random random(4);
  for (int i = 0; i < 20; ++i) {
    const ShotKind kind = i % 2 == 0 ? ShotKind::Rolling : ShotKind::Flying;
    const Shot shot = drawShot(kind, random);
    const double distance = (shot.p_WB.head<2>() - Vector2(-15.0, 0.0)).norm();
    const double speed = shot.v_WB.norm();
    if (kind == ShotKind::Rolling) {
      EXPECT_EQ(shot.v_WB.z(), 0.0);
      EXPECT_TRUE(distance >= 2.0 && distance <= 5.0) << distance;
    } else {
      EXPECT_GT(shot.v_WB.z(), 1.0);
      EXPECT_TRUE(distance >= 4.0 && distance <= 12.0) << distance;
      EXPECT_TRUE(speed >= 7.0 && speed <= 13.0) << speed;
    }
    const auto crossing = freeCrossing(shot);
    ASSERT_TRUE(crossing);
    EXPECT_TRUE(countsAsShot(*crossing));

    sim::Settings settings;
    settings.automaticKickOff = false;
    sim::Simulation simulation(settings, 1);
    simulation.trainer("(playMode PlayOn)");
    simulation.world().setBallPosition(shot.p_WB.cast<float>());
    simulation.world().setBallVelocity(shot.v_WB.cast<float>());
    double time = 0.0;
    while (simulation.world().ballInGoal() == sim::World::Goal::None && time < 6.0) {
      simulation.step();
      time += kCycleTime;
    }
    EXPECT_EQ(simulation.world().ballInGoal(), sim::World::Goal::Left) << i;
    EXPECT_NEAR(time, crossing->time, 0.061) << i;
  }
}

// A share, not single saves: the goalie's noise decides each of them.
TEST(Saves, MostShotsNearTheGoalieAreSavedAndItIsUpAgain) {
  const agent::AgentSettings goalie = goalieOfType(0);
  sim::Settings settings;
  settings.quickSolver = true;
  Random random(11);
  int saved = 0;
  int up = 0;
  int ownGoals = 0;
  constexpr int kShots = 16;
  for (int i = 0; i < kShots; ++i) {
    const Shot shot = drawShot(i % 2 == 0 ? ShotKind::Rolling : ShotKind::Flying, random);
    const Save save = saveOnce(goalie, settings, shot, random.next());
    ownGoals += save.ownGoal ? 1 : 0;
    saved += save.saved ? 1 : 0;
    up += save.up ? 1 : 0;
  }
  RecordProperty("saved", saved);
  EXPECT_GE(saved, kShots * 40 / 100);
  EXPECT_GE(up, kShots - 2);
  EXPECT_LE(ownGoals, 1);
}

TEST(Saves, SameSeedSameSave) {
  const agent::AgentSettings goalie = goalieOfType(0);
  sim::Settings settings;
  settings.quickSolver = true;
  const Shot shot = shotFrom({-12.0, 0.5}, {-7.0, -1.5, 0.0});
  const Save first = saveOnce(goalie, settings, shot, 5);
  const Save second = saveOnce(goalie, settings, shot, 5);
  EXPECT_EQ(first.path, second.path);
  EXPECT_EQ(first.saved, second.saved);
  EXPECT_NE(saveOnce(goalie, settings, shot, 6).path, first.path);
}

}  // namespace
}  // namespace nonet::lab
