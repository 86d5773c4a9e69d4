// Which kick, and the last steps to it: a request "the ball that lies there, to that place" -> the cheapest
// kick of the catalogue, the way to where the robot must stand for it, and the moment to begin.
//
// Needs: the catalogue, the request, the walk. Gives: a speed to walk with, or the kick to begin now.
// After [MacAlpine 2012a, section 5.2]: the cost of a kick is the way to its place in metres, the turn as a
// share of a full one, half a metre when the robot must go around the ball; the time to contact is ours. A
// kick along a curve begins only when the foot can follow it; otherwise the next cheapest is looked at.
#pragma once

#include <array>

#include "nonet/motion/curve_check.h"
#include "nonet/motion/kick_catalogue.h"
#include "nonet/motion/kick_parameters.h"
#include "nonet/motion/request.h"
#include "nonet/motion/walk/engine.h"

namespace nonet::motion {

/// What the kick control wants in a cycle.
struct KickStep {
  const KickOption* option = nullptr;  // the chosen kick; null: there is none that could
  bool inPlace = false;                // the ball lies where that kick wants it
  bool begin = false;                  // now; otherwise walk on:
  bool stand = false;                  // come to a stand
  WalkVelocity walk;                   // or these steps
  KickAim aim;                         // what the kick is told when it begins
};

class KickControl {
 public:
  /// What it is given must outlive it, but for the parameters. Without `check` no curve is looked at.
  KickControl(const KickCatalogue& catalogue, const KickParameters& parameters,
              const CurveCheck* check = nullptr)
      : catalogue_(&catalogue), check_(check), parameters_(parameters) {}

  /// One cycle in which a kick is asked for. `quiet`: s, for which the robot has stood quietly.
  KickStep update(const KickTo& request, const WalkEngine& walk, double quiet);
  /// Nothing is asked for, or a kick has begun: the next request chooses anew.
  void reset() {
    chosen_ = nullptr;
    steady_ = 0.0;
  }

 private:
  struct Way {                          // to the place for a kick
    Vector2 place = Vector2::Zero();    // robot frame, m
    double turn = 0.0;                  // rad
    Vector2 missing = Vector2::Zero();  // of the ball's place as it lies now, m
  };

  Way wayTo(const KickOption& option, const KickTo& request) const;
  double cost(const KickOption& option, const KickTo& request) const;
  bool serves(const KickOption& option, const KickTo& request) const;
  const KickOption* choose(const KickTo& request) const;
  KickStep stepFor(const KickTo& request, const WalkEngine& walk, double quiet);
  KickTo after(double seconds, double drift, const KickTo& request, const WalkEngine& walk) const;
  WalkVelocity lastSteps(const Way& way, const Vector2& along) const;
  bool within(double share, const Way& way) const;

  static constexpr std::size_t kMostChecks = 3;  // in a cycle: what they cost is bounded

  const KickCatalogue* catalogue_;
  const CurveCheck* check_;
  KickParameters parameters_;
  const KickOption* chosen_ = nullptr;
  std::array<const KickOption*, kMostChecks> refused_{};  // in this cycle
  bool comesToStand_ = false;                             // in the last cycle
  double steady_ = 0.0;                                   // s that the ball has lain about in its place
  const KickOption* steadyFor_ = nullptr;                 // for this kick
};

}  // namespace nonet::motion
