#include "nonet/protocol/play_mode.h"

#include <array>
#include <cstddef>

namespace nonet::protocol {
namespace {

// In the order of the server's indices (server facts 1.11).
constexpr std::array<std::string_view, kPlayModeCount> kNames = {"BeforeKickOff",
                                                                 "KickOff_Left",
                                                                 "KickOff_Right",
                                                                 "PlayOn",
                                                                 "KickIn_Left",
                                                                 "KickIn_Right",
                                                                 "corner_kick_left",
                                                                 "corner_kick_right",
                                                                 "goal_kick_left",
                                                                 "goal_kick_right",
                                                                 "offside_left",
                                                                 "offside_right",
                                                                 "GameOver",
                                                                 "Goal_Left",
                                                                 "Goal_Right",
                                                                 "free_kick_left",
                                                                 "free_kick_right",
                                                                 "direct_free_kick_left",
                                                                 "direct_free_kick_right",
                                                                 "pass_left",
                                                                 "pass_right"};

}  // namespace

std::string_view playModeName(PlayMode mode) {
  const auto i = static_cast<std::size_t>(mode);
  return i < kNames.size() ? kNames[i] : "unknown";
}

std::optional<PlayMode> playModeFromName(std::string_view name) {
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (kNames[i] == name) {
      return static_cast<PlayMode>(i);
    }
  }
  return std::nullopt;
}

}  // namespace nonet::protocol
