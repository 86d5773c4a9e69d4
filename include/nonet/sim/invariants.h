// What must hold in every cycle of every match, however robots fall and collide: numbers are finite, joints
// stay within their stops but for the overshoot that the real server shows too, robots are above the ground
// and nothing flies about. A violation means that the physics has broken, not that somebody plays badly.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "nonet/sim/simulation.h"

namespace nonet::sim {

struct InvariantLimits {
  /// Beyond a stop. A joint driven into one by its motor overshoots by up to one step at its greatest speed,
  /// 7.03 degrees (server facts 2.4); but a stop acts only from the next step on, so a leg that is pressed
  /// outwards while the robot rises comes farther. The farthest in recordings of the real server is 17.51
  /// degrees (tests/data/sim/overshoot_type3.log.gz), a hip of type 3.
  double overshoot = 0.3056;      // rad
  double toeOvershoot = 0.3056;   // rad; the toes' own bound, for who sends what no player of ours does
  double overshootMargin = 0.02;  // rad
  double lowestCentre = -0.05;    // m, of any body; the recordings' lowest is a foot at -0.01
  double highestCentre = 12.0;    // m; who is refused drops from 10 (server facts 1.3)
  double fastestBody = 20.0;      // m/s; falls and kicks stay below 10
};

/// The farthest that anything has come.
struct InvariantExtremes {
  double overshoot = 0.0;     // rad beyond a stop
  double lowestCentre = 1e9;  // m
  double fastestBody = 0.0;   // m/s
};

class Invariants {
 public:
  explicit Invariants(const InvariantLimits& limits = {}) : limits_(limits) {}

  /// Looks at all robots and the ball; call it after every step.
  void check(const Simulation& simulation);

  std::uint64_t violations() const { return violations_; }
  /// The first ones, a line each: time, who, what.
  const std::vector<std::string>& messages() const { return messages_; }
  const InvariantExtremes& extremes() const { return extremes_; }

 private:
  void checkBody(const World::BodyState& state, RobotHandle robot, model::BodyId body);
  void checkRobot(const World& world, RobotHandle robot);
  void violate(const std::string& what);

  InvariantLimits limits_;
  InvariantExtremes extremes_;
  std::uint64_t violations_ = 0;
  std::vector<std::string> messages_;
  double time_ = 0.0;
};

}  // namespace nonet::sim
