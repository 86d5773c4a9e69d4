// The speeds of a walk from a stand, from how far it has come cycle by cycle.
#pragma once

#include "nonet/math/types.h"

namespace nonet::lab {

// Of a walk that ends early, what is left of the time at a steady speed counts as a stand.
struct WalkSpeeds {
  static constexpr double kAccelerate = 3.0;  // s, from the stand
  static constexpr double kSteady = 4.0;      // s, measured afterwards

  double fromStand = 0.0;  // m/s over kAccelerate
  double steady = 0.0;     // m/s over kSteady after that; 0 for who falls before

  // After another cycle; distance from the start, m.
  void add(double distance) {
    ++cycles_;
    const int accelerating = static_cast<int>(kAccelerate / kCycleTime);
    if (cycles_ < accelerating) return;
    if (cycles_ == accelerating) {
      before_ = distance;
      fromStand = distance / kAccelerate;
    }
    steady = (distance - before_) / kSteady;
  }

 private:
  int cycles_ = 0;
  double before_ = 0.0;
};

}  // namespace nonet::lab
