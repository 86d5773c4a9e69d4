// A robot whose walk is measured: it can be put somewhere and told how to walk, and its true pose is known;
// in process or on a server.
#pragma once

#include <memory>

#include "nonet/lab/trial/robot_trial.h"
#include "nonet/lab/trial/server_address.h"

namespace nonet::lab {

/// Where the ball lies on a server's field meanwhile, m: in nobody's way.
inline const Vector2 kMeasuredRobotBall{0.0, -9.5};

class MeasuredRobot {
 public:
  virtual ~MeasuredRobot() = default;
  /// Stands quietly at X_FR (roughly: a server moves robots to 0.01 m), whatever happened before.
  virtual void settle(const Pose2& X_FR) = 0;
  virtual void step(const motion::MotionRequest& request) = 0;
  virtual Pose2 pose() const = 0;
  virtual bool down() const = 0;
  virtual const world::WorldState& belief() const = 0;

  void run(const motion::MotionRequest& request, double seconds) {
    for (int i = 0; i < static_cast<int>(seconds / kCycleTime); ++i) step(request);
  }
};

/// On the in-process physics.
std::unique_ptr<MeasuredRobot> makeMeasuredRobot(const TrialSettings& setup);

/// On any server, embedded or real, in lock-step or real time; the true pose comes from its monitor stream.
/// The server must be otherwise empty. Throws std::runtime_error that names the address when it cannot be
/// reached or refuses.
std::unique_ptr<MeasuredRobot> connectMeasuredRobot(const TrialSettings& setup, const ServerAddress& address);

}  // namespace nonet::lab
