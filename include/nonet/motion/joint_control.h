// Joint control: target angles -> joint speeds for the server, per joint.
//
// A command given in answer to message k acts first on the angle in message k+2, so one earlier command is
// always still under way: the controller predicts the angle it will find, then closes the gap (server
// facts 1.2, 2.4). With the joint as the server's (it takes any speed within one step) and the default gains
// the target of message k is the angle in message k+2, if the joint's speed allows.
//
// Stops: the server ignores commands to a joint at or beyond its stop, and throws it back with full
// restitution (server facts 2.4). So targets are moved to stopMargin inside, and no command leads beyond
// that.
#pragma once

#include <array>

#include "nonet/model/robot_model.h"
#include "nonet/motion/parameters.h"
#include "nonet/motion/request.h"
#include "nonet/protocol/effectors.h"
#include "nonet/world/body_state.h"

namespace nonet::motion {

class JointControl {
 public:
  JointControl(const model::RobotModel& model, const ControlParameters& parameters);

  /// Fills the speeds of all joints the robot has, with the digits that the text will have. Lost messages are
  /// told by body.cycleTime: a command stays in force until the next one. A target that is not a finite
  /// number stops its joint.
  void update(const world::BodyState& body, const JointTargets& targets, protocol::Effectors& effectors);

  /// Forgets everything: for a robot that has just been built (all its commands are 0).
  void reset();

 private:
  struct Joint {
    double low;  // rad, stopMargin inside the stops
    double high;
    double lowStop;  // rad
    double highStop;
    double maxSpeed;  // rad/s, as the server rounds it
  };

  double speedFor(std::size_t i, double predicted, double error, double cycles);

  const model::RobotModel* model_;
  ControlParameters parameters_;
  std::array<Joint, model::kJointCount> joints_{};
  model::JointArray underWay_{};   // in force until the next command takes effect, rad/s
  model::JointArray integral_{};   // sum of the errors, one per cycle, rad
  model::JointArray lastError_{};  // rad
  bool hasLastError_ = false;
};

}  // namespace nonet::motion
