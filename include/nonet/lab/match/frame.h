// One moment of a match as anybody can see it: the plain form that statistics, reports and viewers work on,
// whatever the match is played on (frame_sources.h makes frames).
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "nonet/math/types.h"
#include "nonet/protocol/play_mode.h"

namespace nonet::lab {

/// Index of a team: 0 began on the left, 1 on the right. It keeps its index when sides are changed.
using TeamIndex = int;

struct FrameRobot {
  TeamIndex team = 0;
  int unum = 0;
  int robotType = 0;
  Vector3 p_W = Vector3::Zero();  // torso, world frame: x from the left goal to the right one, m
  double up = 1.0;                // z of the torso's up axis: 1 upright, 0 lying
  std::string_view role;          // empty: not known. Must outlive the statistics (a literal)
  std::string_view kick;          // that it carries out or has just ended; empty: none, or not known
};

struct FrameFoul {
  int type = 0;  // sim::FoulType
  TeamIndex team = 0;
  int unum = 0;
};

struct Frame {
  double time = 0.0;  // of the game, s; stands still before kick-offs
  protocol::PlayMode mode = protocol::PlayMode::BeforeKickOff;
  bool swapped = false;  // team 0 plays from the right now
  std::array<int, 2> score{};
  Vector3 p_WBall = Vector3::Zero();
  std::vector<FrameRobot> robots;
  std::vector<FrameFoul> fouls;  // given since the frame before

  /// The team that a play mode names (whose kick or goal it is); -1 for modes that name none.
  TeamIndex teamOfMode() const;
  /// World -> the frame of a team, in which it plays towards +x.
  Vector2 seenBy(TeamIndex team, const Vector3& p_W) const {
    return (team == 1) != swapped ? Vector2(-p_W.x(), -p_W.y()) : Vector2(p_W.x(), p_W.y());
  }
};

/// Kick-offs, kick-ins, corner, goal and free kicks: modes in which one team puts the ball into play.
bool isSetPiece(protocol::PlayMode mode);
/// "kick_off", "kick_in", "corner_kick", "goal_kick", "free_kick", "direct_free_kick", "pass", "goal",
/// "offside"; "" for modes of no team.
std::string_view kindOfMode(protocol::PlayMode mode);

}  // namespace nonet::lab
