#include "nonet/lab/match/frame.h"

namespace nonet::lab {
namespace {

using protocol::PlayMode;

}  // namespace

std::string_view kindOfMode(PlayMode mode) {
  switch (mode) {
    case PlayMode::KickOffLeft:
    case PlayMode::KickOffRight:
      return "kick_off";
    case PlayMode::KickInLeft:
    case PlayMode::KickInRight:
      return "kick_in";
    case PlayMode::CornerKickLeft:
    case PlayMode::CornerKickRight:
      return "corner_kick";
    case PlayMode::GoalKickLeft:
    case PlayMode::GoalKickRight:
      return "goal_kick";
    case PlayMode::FreeKickLeft:
    case PlayMode::FreeKickRight:
      return "free_kick";
    case PlayMode::DirectFreeKickLeft:
    case PlayMode::DirectFreeKickRight:
      return "direct_free_kick";
    case PlayMode::PassLeft:
    case PlayMode::PassRight:
      return "pass";
    case PlayMode::OffsideLeft:
    case PlayMode::OffsideRight:
      return "offside";
    case PlayMode::GoalLeft:
    case PlayMode::GoalRight:
      return "goal";
    case PlayMode::BeforeKickOff:
    case PlayMode::PlayOn:
    case PlayMode::GameOver:
    case PlayMode::Unknown:
      break;
  }
  return "";
}

bool isSetPiece(PlayMode mode) {
  const std::string_view kind = kindOfMode(mode);
  return !kind.empty() && kind != "pass" && kind != "offside" && kind != "goal";
}

TeamIndex Frame::teamOfMode() const {
  switch (mode) {
    case PlayMode::BeforeKickOff:
    case PlayMode::PlayOn:
    case PlayMode::GameOver:
    case PlayMode::Unknown:
      return -1;
    case PlayMode::KickOffRight:
    case PlayMode::KickInRight:
    case PlayMode::CornerKickRight:
    case PlayMode::GoalKickRight:
    case PlayMode::OffsideRight:
    case PlayMode::GoalRight:
    case PlayMode::FreeKickRight:
    case PlayMode::DirectFreeKickRight:
    case PlayMode::PassRight:
      return swapped ? 0 : 1;
    default:
      return swapped ? 1 : 0;
  }
}

}  // namespace nonet::lab
