#include "nonet/motion/motion.h"

#include "nonet/motion/head_control.h"
#include "nonet/motion/limbs.h"

namespace nonet::motion {

namespace {

// Takes out the jump when another source of targets takes over: the difference to what was commanded last
// fades away.
class Transition {
 public:
  void begin(const model::JointArray& from, const model::JointArray& to, double duration) {
    for (std::size_t i = 0; i < model::kJointCount; ++i) offset_[i] = from[i] - to[i];
    duration_ = duration;
    left_ = duration;
  }
  void apply(double time, model::JointArray& angles) {
    if (left_ <= 0.0) return;
    left_ -= time;
    const double share = left_ > 0.0 ? left_ / duration_ : 0.0;
    const double smooth = share * share * (3.0 - 2.0 * share);
    for (std::size_t i = 0; i < model::kJointCount; ++i) angles[i] += smooth * offset_[i];
  }

 private:
  model::JointArray offset_{};
  double duration_ = 0.0;
  double left_ = 0.0;
};

}  // namespace

struct Motion::Stages {
  Stages(const model::RobotModel& robot, const MotionParameters& motionParameters)
      : model(&robot), parameters(motionParameters), head(robot, motionParameters.head) {
    const StandParameters& stand = parameters.stand;
    FootPoses feet{Pose3::Identity(), Pose3::Identity()};
    for (const model::Side side : {model::Side::Left, model::Side::Right}) {
      feet[index(side)].translation() =
          Vector3(stand.xOffset, 0.5 * sideSign(side) * stand.ySep, -stand.height * robot.standingHeight());
      setArm(side, ArmAttitude{stand.armPitch, stand.armYaw, 0.0, stand.elbow}, standing);
    }
    setLegs(robot, feet, standing);
  }

  const model::RobotModel* model;
  MotionParameters parameters;
  HeadControl head;
  Transition transition;
  model::JointArray standing{};
  JointTargets targets;
  MotionState state;
  bool started = false;
};

Motion::Motion(const model::RobotModel& model, const MotionParameters& parameters,
               [[maybe_unused]] const std::string& skillFolder)
    : stages_(std::make_unique<Stages>(model, parameters)) {}
Motion::~Motion() = default;

const MotionState& Motion::state() const {
  return stages_->state;
}

const JointTargets& Motion::update(const world::WorldState& world,
                                   [[maybe_unused]] const MotionRequest& request, const HeadRequest& head) {
  Stages& s = *stages_;
  s.state = MotionState{};
  if (!s.started) {
    s.transition.begin(world.body.joints, s.standing, s.parameters.stand.blendTime);
    s.started = true;
  }
  s.targets.angles = s.standing;
  s.targets.stiffness.fill(1.0);
  s.transition.apply(world.body.cycleTime, s.targets.angles);
  s.head.update(world.body, head, s.targets);
  return s.targets;
}

}  // namespace nonet::motion
