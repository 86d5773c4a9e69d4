// Joint control: target angles -> joint speeds for the server, per joint.
//
// A command given in answer to message k acts first on the angle in message k+2, so one earlier command is
// always still under way: the controller predicts the angle it will find, then closes the gap (server
// facts 1.2, 2.4).
#pragma once

#include "nonet/model/robot_model.h"
#include "nonet/motion/parameters.h"
#include "nonet/motion/request.h"
#include "nonet/protocol/effectors.h"
#include "nonet/world/body_state.h"

namespace nonet::motion {

class JointControl {
 public:
  JointControl(const model::RobotModel& model, const ControlParameters& parameters);

  /// Fills the speeds of all joints the robot has.
  void update(const world::BodyState& body, const JointTargets& targets, protocol::Effectors& effectors);
  void reset();

 private:
  const model::RobotModel* model_;
  ControlParameters parameters_;
  model::JointArray underWay_{};   // commanded in the last cycle, not yet visible, rad/s
  model::JointArray integral_{};   // rad s
  model::JointArray lastError_{};  // rad
};

}  // namespace nonet::motion
