// A time to go by where the server's stands still.
#pragma once

#include <cmath>
#include <limits>

#include "nonet/math/types.h"

namespace nonet::protocol {

/// After six days the server's time, a 32-bit sum, does not grow any more (serverStep). The messages go on,
/// one a cycle, and are counted instead. The turns to speak follow from the time, so that all of a team must
/// count alike: as soon as the game's clock runs, they count in step with it.
class StandingTime {
 public:
  /// What to take for the time of one more message (s), from the server's time and the game's.
  double next(double serverTime, double gameTime) {
    ++cycles_;
    const double behind =
        std::remainder(gameTime / kCycleTime - static_cast<double>(cycles_), static_cast<double>(kRound));
    if (gameTime > gameTime_ && std::abs(behind) > 1.5)
      cycles_ += std::lround(behind) + (behind < 0.0 ? kRound : 0);
    gameTime_ = gameTime;
    return serverTime + static_cast<double>(cycles_) * kCycleTime;
  }
  bool stands() const { return cycles_ >= 0; }

 private:
  static constexpr long kRound = 22;  // cycles in which everybody has a turn

  long cycles_ = -1;                                            // since the first message of that time
  double gameTime_ = std::numeric_limits<double>::quiet_NaN();  // s
};

}  // namespace nonet::protocol
