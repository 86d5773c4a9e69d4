// The state of the game that agents and monitors see: play mode, clock, halves, scores; and the register of
// teams, uniform numbers and robot types (server facts 1.3, 1.4, 4.2, 4.3). The rules that change it are in
// referee.h.
//
// Teams are kept in two slots. A slot's name, score, numbers and pass mode stay together; changing sides
// exchanges which slot plays left.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "nonet/math/random.h"
#include "nonet/protocol/percept.h"
#include "nonet/protocol/play_mode.h"
#include "nonet/sim/physics/world.h"
#include "nonet/sim/settings/settings.h"

namespace nonet::sim {

using protocol::PlayMode;
using protocol::TeamName;
using protocol::TeamSide;

inline constexpr int kMaxUnum = 11;

constexpr TeamSide opponentOf(TeamSide side) {
  return side == TeamSide::Left ? TeamSide::Right : side == TeamSide::Right ? TeamSide::Left : TeamSide::None;
}
/// For the log.
constexpr std::string_view sideName(TeamSide side) {
  return side == TeamSide::Left ? "left" : side == TeamSide::Right ? "right" : "none";
}
constexpr std::size_t index(TeamSide side) {
  return static_cast<std::size_t>(side);
}

class GameState {
 public:
  explicit GameState(const Settings& settings);

  // -- clock and play mode
  /// Adds one cycle to the clock of the present mode: game time stands still before kick-off and after the
  /// end.
  void advance(float seconds);
  PlayMode playMode() const { return playMode_; }
  /// Does nothing if `mode` is already on.
  void setPlayMode(PlayMode mode);
  float time() const { return time_; }  // of the game, s
  void setTime(float time) { time_ = time; }
  /// Seconds in the present mode.
  float modeTime() const;
  /// Game time at which the present mode began.
  float lastModeChange() const { return lastModeChange_; }
  int half() const { return half_; }
  void setHalf(int half) { half_ = half; }
  /// Agents may beam and no foul is called.
  bool paused() const { return paused_; }
  void setPaused(bool paused) { paused_ = paused; }
  /// Kick-off; for None the team that is due, or a fair coin (server facts 4.3).
  void kickOff(TeamSide side, const Settings& settings, Random& random);

  // -- teams
  enum class Refusal : std::uint8_t { None, ThirdTeam, NumberTaken, NumberRange, TypeRule, TeamName };
  /// Registers a player. On success `side` and `unum` (which was 0 for "any") are set.
  Refusal registerPlayer(std::string_view team, int robotType, TeamSide& side, int& unum,
                         const Settings& settings);
  void releasePlayer(TeamSide side, int unum, int robotType);
  /// The next start position of this side, and the torso's yaw in degrees. (0, 0, 10) and 0 for None.
  Vector3f nextStartPosition(TeamSide side, const Settings& settings);
  static float startYaw(TeamSide side);
  TeamName teamName(TeamSide side) const;
  int score(TeamSide side) const;
  void scoreGoal(TeamSide side);
  void setScores(int left, int right);
  void swapSides();

  // -- pass mode, per side
  float lastPassModeTime(TeamSide side) const;  // of the game, s, when it was last on
  void setLastPassModeTime(TeamSide side, float time);
  bool passModeClearedToScore(TeamSide side) const;
  void setPassModeClearedToScore(TeamSide side, bool cleared);
  /// Seconds for which this team may still not score because of its pass mode; 0 if it may.
  float passModeScoreWait(TeamSide side, const Settings& settings) const;

 private:
  static constexpr int kTypes = model::kRobotTypeCount;
  struct Team {
    TeamName name;
    int score = 0;
    std::array<bool, kMaxUnum + 1> numberUsed{};
    std::array<int, kTypes> typeCount{};
    float lastPassModeTime = -1000.0F;
    bool clearedToScore = false;
  };

  const Team& team(TeamSide side) const { return teams_[side == TeamSide::Left ? leftSlot_ : 1 - leftSlot_]; }
  Team& team(TeamSide side) { return teams_[side == TeamSide::Left ? leftSlot_ : 1 - leftSlot_]; }
  TeamSide sideOfTeam(std::string_view name);
  bool typeAllowed(const Team& team, int type, const Settings& settings) const;

  PlayMode playMode_ = PlayMode::BeforeKickOff;
  float time_ = 0.0F;
  float beforeKickOffTime_ = 0.0F;
  float gameOverTime_ = 0.0F;
  float lastModeChange_ = 0.0F;
  int half_ = 1;
  int lastKickOffHalf_ = 0;
  TeamSide nextHalfKickOff_ = TeamSide::None;
  bool paused_ = true;
  int leftSlot_ = 0;
  std::array<Team, 2> teams_;
  Vector3f nextLeftStart_ = Vector3f::Zero();
  Vector3f nextRightStart_ = Vector3f::Zero();
};

}  // namespace nonet::sim
