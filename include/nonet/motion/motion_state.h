// What the body is doing: motion's word to the next cycle's decision.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "nonet/math/pose2.h"
#include "nonet/motion/kick_catalogue.h"
#include "nonet/motion/request.h"

namespace nonet::motion {

/// The kick that is chosen or runs.
struct KickState {
  std::string_view name;  // empty: none
  model::Side foot = model::Side::Left;
  bool inPlace = false;  // the ball lies where it wants it
  KickAim aim;           // what it would be told if it began now
};

struct MotionState {
  MotionRequest request;       // what was asked for in the last cycle
  bool rising = false;         // getting up
  bool busy = false;           // a skill or kick runs that must not be interrupted
  bool skillFinished = false;  // the requested skill ended in this cycle
  std::optional<Pose2> beam;   // asked for in the last cycle, own field frame
  KickState kick;

  std::span<const KickOption> kicks;  // all that this robot can do

  bool askedForKick() const { return std::holds_alternative<KickTo>(request); }
  bool kickInPlace() const { return askedForKick() && kick.inPlace; }  // and the ball lies where it wants it
};

}  // namespace nonet::motion
