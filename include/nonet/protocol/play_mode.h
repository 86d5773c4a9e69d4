// The server's play modes: names, indices and meaning (server facts 1.11). "_left" = the left team takes the
// kick.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace nonet::protocol {

enum class PlayMode : std::uint8_t {
  BeforeKickOff,
  KickOffLeft,
  KickOffRight,
  PlayOn,
  KickInLeft,
  KickInRight,
  CornerKickLeft,
  CornerKickRight,
  GoalKickLeft,
  GoalKickRight,
  OffsideLeft,
  OffsideRight,
  GameOver,
  GoalLeft,
  GoalRight,
  FreeKickLeft,
  FreeKickRight,
  DirectFreeKickLeft,
  DirectFreeKickRight,
  PassLeft,
  PassRight,
  Unknown,
};
inline constexpr int kPlayModeCount = 21;

std::string_view playModeName(PlayMode mode);  // "BeforeKickOff", "corner_kick_left", ...
std::optional<PlayMode> playModeFromName(std::string_view name);

}  // namespace nonet::protocol
