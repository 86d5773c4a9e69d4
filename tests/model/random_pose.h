// Random joint angles for the tests of this folder.
#pragma once

#include "nonet/math/random.h"
#include "nonet/model/robot_model.h"

namespace nonet::model {

/// Uniform within the limits of each joint, rad.
inline JointArray randomAngles(const RobotModel& model, Random& random) {
  JointArray angles{};
  for (const JointSpec& joint : model.joints()) {
    angles[index(joint.id)] = random.uniform(joint.low, joint.high);
  }
  return angles;
}

}  // namespace nonet::model
