// What the robot has decided to do in this cycle.
#pragma once

#include <optional>

#include "nonet/math/inline_string.h"
#include "nonet/math/pose2.h"
#include "nonet/motion/request.h"

namespace nonet::team {

struct Intent {
  motion::MotionRequest motion;
  motion::HeadRequest head;
  std::optional<Pose2> beam;            // own field frame
  std::optional<InlineString<64>> say;  // at most 20 allowed characters
  bool pass = false;                    // ask for pass mode
};

}  // namespace nonet::team
