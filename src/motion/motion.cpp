#include "nonet/motion/motion.h"

#include "nonet/motion/head_control.h"
#include "nonet/motion/walk_control.h"

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
      : model(&robot),
        parameters(motionParameters),
        walk(robot, motionParameters.sets, motionParameters.selection),
        head(robot, motionParameters.head) {}

  const model::RobotModel* model;
  MotionParameters parameters;
  WalkControl walk;
  HeadControl head;
  Transition transition;
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

const JointTargets& Motion::update(const world::WorldState& world, const MotionRequest& request,
                                   const HeadRequest& head) {
  Stages& s = *stages_;
  s.state = MotionState{};
  s.walk.update(world, request, s.targets);
  if (!s.started) {
    s.transition.begin(world.body.joints, s.targets.angles, s.parameters.transition.standTime);
    s.started = true;
  }
  s.transition.apply(world.body.cycleTime, s.targets.angles);
  s.head.update(world.body, head, s.targets);
  return s.targets;
}

}  // namespace nonet::motion
