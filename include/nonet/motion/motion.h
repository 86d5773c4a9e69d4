// The motion stage: WorldState and requests -> JointTargets. Chooses among standing, walking, skills, kicks,
// falling and rising, and moves between them without a jump.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "nonet/model/robot_model.h"
#include "nonet/motion/fall_control.h"
#include "nonet/motion/motion_state.h"
#include "nonet/motion/parameters.h"
#include "nonet/motion/request.h"
#include "nonet/motion/walk/control.h"
#include "nonet/world/world_state.h"

namespace nonet::motion {

class Motion {
 public:
  /// `skillFolder` holds the *.skl files; errors name file, line and column.
  Motion(const model::RobotModel& model, const MotionParameters& parameters, const std::string& skillFolder);
  ~Motion();

  /// With a `beam` the robot is about to be put down there at rest: it stands instead of ending its steps.
  const JointTargets& update(const world::WorldState& world, const MotionRequest& request,
                             const HeadRequest& head, const std::optional<Pose2>& beam = {});
  const MotionState& state() const;
  /// For measurements and drawings.
  const WalkControl& walk() const;
  const FallControl& fall() const;

 private:
  struct Stages;
  std::unique_ptr<Stages> stages_;
};

}  // namespace nonet::motion
