// How a kicked ball flies: its height a metre from where it lay, where it is highest, and where it comes down
// first.
#pragma once

#include "nonet/lab/trial/kick_trial.h"
#include "nonet/world/ball_law.h"

namespace nonet::lab {

class BallFlight {
 public:
  explicit BallFlight(const Vector2& p_FBegin) : p_FBegin_(p_FBegin) {}

  /// Once a cycle.
  void note(const world::BallMotion& ball);
  /// What was noted; of a ball that is still in the air where it will come down.
  void tell(Kick& kick) const;

 private:
  Vector2 p_FBegin_;
  world::BallMotion ball_{};  // as noted last
  bool flew_ = false;
  double height_ = 0.0;   // m
  double highest_ = 0.0;  // m
  double landing_ = 0.0;  // m
};

}  // namespace nonet::lab
