// One seeded shot at a goalie that plays by itself: vision and noise on, open play. It guards its goal while
// the ball lies in front of an opponent, then the ball is thrown at the goal as a kick would have it fly.
//
// Only shots that are worth a save count: simulated without the robots on the exact world, the ball crosses
// the goal line between the posts, low enough and fast enough. World axes; the goal is the left one, at
// x = -15 m.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "nonet/agent/agent.h"
#include "nonet/math/random.h"
#include "nonet/sim/settings/settings.h"

namespace nonet::lab {

enum class ShotKind : std::uint8_t { Rolling, Flying };

struct Shot {
  ShotKind kind = ShotKind::Rolling;
  Vector3 p_WB = Vector3::Zero();  // where the ball lies, m
  Vector3 v_WB = Vector3::Zero();  // what it gets, m/s, without spin
};

/// The goal line as a ball crosses it that nobody touches.
struct GoalLineCrossing {
  double time = 0.0;    // s from the shot
  double y = 0.0;       // m
  double height = 0.0;  // of its centre, m
  double speed = 0.0;   // m/s
};

/// Nothing if the ball does not come to the line within ten seconds.
std::optional<GoalLineCrossing> freeCrossing(const Shot& shot);
/// Between the posts without touching them, below 0.75 m, at 1.5 m/s or more.
bool countsAsShot(const GoalLineCrossing& crossing);

/// Draws a place, and shots from there until one counts. Rolling: 2 to 5 m from the middle of the goal, up to
/// 10 m/s at the begin (without spin: a third is lost until the ball rolls). Flying: 4 to 12 m, 7 to 13 m/s,
/// 10 to 60 degrees upwards. All from within 60 degrees of the goal's axis, to anywhere between the posts.
Shot drawShot(ShotKind kind, Random& random);

struct Save {
  Shot shot;
  bool saved = false;    // no goal until the trial is over
  bool ownGoal = false;  // the shot was stopped, and the ball came into the goal afterwards
  bool touched = false;
  bool fell = false;
  bool up = false;        // stands at the end
  double riseTime = 0.0;  // s on the ground
  bool cleared = false;   // of a saved ball: it is away from the goal at the end
  double aside = 0.0;  // m from the robot's middle to where the free ball would have passed it, left positive
  std::string answer;  // what the goalie answered first: name of its skill or of its case
  double answerTime = 0.0;    // s from the shot until then
  std::vector<Vector3> path;  // of the ball until the shot was over
  Pose2 X_WStart;             // of the goalie at the shot
};

/// The same arguments always give the same save.
Save saveOnce(const agent::AgentSettings& goalie, const sim::Settings& settings, const Shot& shot,
              std::uint64_t seed);

}  // namespace nonet::lab
