// What one robot senses of a World, as the values that the text of a sense message would carry: joints, gyro,
// accelerometer, foot force, and vision with its noise, calibration error, view cone and clipped lines.
// Server facts 1.5, 1.6, 2.6, 2.7. Arithmetic is 32-bit where the server's is.
#pragma once

#include <span>
#include <vector>

#include "nonet/math/random.h"
#include "nonet/protocol/percept.h"
#include "nonet/sim/physics/world.h"
#include "nonet/sim/sensors/vision.h"

namespace nonet::sim {

/// A robot whose init succeeded: others see it under this name.
struct VisiblePlayer {
  RobotHandle robot = kNoRobot;
  protocol::TeamName team;
  int unum = 0;
};

/// What is the same for all robots, or comes from the referee.
struct SensorContext {
  const VisionField* field = nullptr;                  // fixed objects and lines
  std::span<const VisiblePlayer> players;              // in order of connection
  protocol::TeamSide side = protocol::TeamSide::None;  // of the sensing robot, now; turns the truth values
  bool vision = true;                                  // this message has a See
  bool noise = true;                                   // vision noise and calibration error
  bool truePosition = false;                           // mypos
  bool trueHeading = false;                            // myorien
  bool trueBallPosition = false;                       // ballpos
};

class AgentSensors {
 public:
  /// Draws the calibration error of this robot.
  explicit AgentSensors(Random& random) : calibration_(drawCalibration(random)) {}
  /// With a given calibration error, m, head axes of the server (x right, y forward, z up).
  explicit AgentSensors(const Vector3f& calibration) : calibration_(calibration) {}

  /// Fills gyro, accelerometer, joints, forces and vision of `percept` and appends their entries to its
  /// order, in the order of the server's messages. Time, game state and what was heard are the caller's,
  /// before. `random` is the agent's own generator: noise is drawn object by object.
  void fill(const World& world, RobotHandle self, const SensorContext& context, Random& random,
            protocol::Percept& percept);

  const Vector3f& calibration() const { return calibration_; }

 private:
  void addJoint(const World& world, RobotHandle self, model::JointId joint, protocol::Percept& percept) const;
  void addForce(const World& world, RobotHandle self, protocol::ForceSensor sensor,
                protocol::Percept& percept) const;
  void addLeg(const World& world, RobotHandle self, bool left, protocol::Percept& percept) const;

  Vector3f calibration_;
};

}  // namespace nonet::sim
