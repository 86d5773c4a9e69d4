// Kicks with the whole approach, on the complete simulation: seeded starts and a rate that must be reached.
#include "nonet/lab/trial/kick_trial.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "nonet/config/assignment.h"
#include "nonet/math/angle.h"
#include "nonet/sim/settings/settings.h"

#include "lab/trial_setup.h"

namespace nonet::lab {
namespace {

// The ball still rolls away from the dribbler that has pushed it. Whoever begins the kick while it lies ahead
// of its place meets it with the wrong part of the swing.
TEST(Kicks, ReachABallThatTheRobotHasPushed) {
  const agent::AgentSettings agent = agentOfType(2);
  sim::Settings server;
  server.quickSolver = true;
  constexpr int kKicks = 24;
  constexpr double kWeak = 4.0;  // m/s
  int weak = 0, fell = 0;
  for (int i = 0; i < kKicks; ++i) {
    KickScene scene;
    scene.start = 0.35 + 0.05 * (i % 12);
    scene.bearing = 0.3 * kickBearing(i);
    scene.pushed = 0.5 + 0.25 * (i % 5);
    const Kick kick = kickOnce(agent, server, scene, static_cast<std::uint64_t>(i));
    weak += kick.ballSpeed < kWeak ? 1 : 0;
    fell += kick.fell ? 1 : 0;
  }
  EXPECT_LE(weak, 2);
  EXPECT_LE(fell, 2);
}

// Out of steps that close on the ball too fast the foot gets under it: a shot that was to be low flies over
// the bar.
TEST(Kicks, StayLowOutOfARun) {
  const agent::AgentSettings agent = agentOfType(2);
  sim::Settings server;
  server.quickSolver = true;
  constexpr int kKicks = 40;
  constexpr double kBar = 0.8;  // m
  int over = 0, weak = 0;
  for (int i = 0; i < kKicks; ++i) {
    KickScene scene;
    scene.kick = "kick_quick";
    scene.start = 5.0;
    scene.bearing = 0.0;
    const Kick kick = kickOnce(agent, server, scene, static_cast<std::uint64_t>(i));
    over += kick.highest > kBar ? 1 : 0;
    weak += kick.ballSpeed < 4.0 ? 1 : 0;
  }
  EXPECT_LE(over, 1);
  EXPECT_LE(weak, 2);
}

// After a pass the robot runs after its ball. Where the run begins too far aside it falls in the first steps.
TEST(Kicks, ArePassesThatTheRobotCanRunAfter) {
  const agent::AgentSettings agent = agentOfType(2);
  sim::Settings server;
  server.quickSolver = true;
  constexpr int kKicks = 60;
  int fell = 0, weak = 0;
  for (int i = 0; i < kKicks; ++i) {
    KickScene scene;
    scene.kick = "kick_pass";
    scene.bearing = kickBearing(i);
    scene.distance = 5.0;
    const Kick kick = kickOnce(agent, server, scene, static_cast<std::uint64_t>(i));
    fell += kick.fell ? 1 : 0;
    weak += kick.tooShort() ? 1 : 0;
  }
  EXPECT_LE(fell, 1);
  EXPECT_LE(weak, 1);
}

// As after a short pass: the ball rolls out at the feet of a robot that waits for it. Whoever follows it
// aside, or kicks while it comes, lets the foot pass it.
TEST(Kicks, ReachABallThatHasRolledToTheFeet) {
  sim::Settings server;
  server.quickSolver = true;
  constexpr int kKicks = 20;
  constexpr double kWeak = 4.0;  // m/s
  for (const int type : {1, 2, 4}) {
    const agent::AgentSettings agent = agentOfType(type);
    int weak = 0;
    for (int i = 0; i < kKicks; ++i) {
      KickScene scene;
      scene.bearing = kickBearing(i);
      scene.passed = 2.0 + 0.4 * (i % 4);
      const Kick kick = kickOnce(agent, server, scene, static_cast<std::uint64_t>(i));
      weak += kick.ballSpeed < kWeak ? 1 : 0;
    }
    EXPECT_LE(weak, 5) << "of 20, type " << type;
  }
}

// The referee takes a ball back that has crossed a line: that is no part of the kick, which is worth what it
// would have been elsewhere.
TEST(Kicks, EndWhereTheBallLeavesTheField) {
  const agent::AgentSettings agent = agentOfType(3);
  sim::Settings server;
  server.quickSolver = true;
  constexpr double kFastest = 20.0;  // m/s
  int left = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    KickScene scene;
    scene.kick = "kick_long";
    scene.start = 0.5;
    const Kick kick = kickOnce(agent, server, scene, seed);
    if (!kick.contact || kick.path.size() < 2) continue;
    for (std::size_t i = 1; i < kick.path.size(); ++i)
      EXPECT_LT((kick.path[i] - kick.path[i - 1]).norm(), kFastest * kCycleTime) << seed;
    // Seconds after the contact a ball in the field has nearly come to rest.
    const Vector2 last = kick.path.back().head<2>();
    const Vector2 rest(kick.forward, kick.aside);
    left += (rest - last).norm() > 3.0 ? 1 : 0;
  }
  EXPECT_GT(left, 0) << "no ball left the field";
}

struct KickCounts {
  int good = 0;  // so far and so straight as asked for
  int fell = 0;
};

// From every side; the starts are `nearest` and up to eleven times `apart` farther from the ball, m.
KickCounts countKicks(int robotType, const char* name, double nearest, double apart, double least, double off,
                      int kicks = 20) {
  const agent::AgentSettings agent = agentOfType(robotType);
  sim::Settings server;
  server.quickSolver = true;
  KickCounts counts;
  for (int i = 0; i < kicks; ++i) {
    KickScene scene;
    scene.kick = name;
    scene.bearing = kickBearing(i);
    scene.start = nearest + apart * (i % 12);
    const Kick kick = kickOnce(agent, server, scene, static_cast<std::uint64_t>(i));
    counts.good += kick.forward > least && std::abs(kick.direction()) < off ? 1 : 0;
    counts.fell += kick.fell ? 1 : 0;
  }
  return counts;
}

// 60 degrees from where it faces.
TEST(Kicks, ToTheSideGoWhereTheyShould) {
  constexpr int kKicks = 60;
  const KickCounts counts = countKicks(2, "kick_side", 0.35, 0.05, 5.0, toRadians(10.0), kKicks);
  EXPECT_GE(counts.good, 54);
  EXPECT_LE(counts.fell, 6);
}

// Who waits until the ball lies exactly right kicks it nearly the same each time.
TEST(Kicks, WithTheBallExactlyInItsPlaceGoFarAndStraight) {
  const KickCounts counts = countKicks(1, "kick_long", 0.5, 0.1, 13.5, toRadians(3.0));
  EXPECT_GE(counts.good, 18);
  EXPECT_LE(counts.fell, 1);
}

// The referee sees a kick that ends with crossed legs, and none of ours.
TEST(Kicks, ThatCrossTheLegsAreFouls) {
  agent::AgentSettings agent = agentOfType(2);
  sim::Settings server;
  server.quickSolver = true;
  const auto fouls = [&] {
    int count = 0;
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
      KickScene scene;
      scene.kick = "kick_power";
      if (kickOnce(agent, server, scene, seed).selfCollided) ++count;
    }
    return count;
  };
  EXPECT_EQ(fouls(), 0);
  for (const char* change : {"hipRoll4=-0.41", "hipRollStance4=-0.41", "hipRollLand=-0.41",
                             "hipRollStanceLand=-0.41", "kneeLand=-2", "settle=0.6"})
    config::assignParameter(agent.parameters, std::string("motion.skills.kick_power.") + change);
  EXPECT_GE(fouls(), 5);
}

}  // namespace
}  // namespace nonet::lab
