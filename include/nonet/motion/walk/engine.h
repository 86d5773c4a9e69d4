// The omnidirectional walk: a linear inverted pendulum with the parameters of [MacAlpine 2012b].
//
// Needs: a parameter set, the wanted speed, the measured body. Gives: both foot poses, through the inverse
// kinematics the leg joints, and the arms.
//
// It puts the layers together, each in a file of its own: gait (when and where the feet step), pendulum (the
// torso over them), posture (lean and arms), balance (small corrections by what is measured), recovery (far
// tilts), run (what a run adds).
#pragma once

#include "nonet/motion/request.h"
#include "nonet/motion/walk/parameters.h"
#include "nonet/motion/walk/run.h"
#include "nonet/world/body_state.h"

namespace nonet::motion {

/// What the engine planned in the last cycle, for plots and tests.
struct WalkTrace {
  FootPoses feet{};                          // X_RS as commanded
  Vector3 p_SComDesired = Vector3::Zero();   // centre of mass over the stance foot as commanded, delayed, m
  Vector3 p_SComMeasured = Vector3::Zero();  // the same as measured
  model::Reach reach = model::Reach::Exact;
};

class WalkEngine {
 public:
  explicit WalkEngine(const model::RobotModel& model, const RunParameters& run = {});

  /// One cycle. The set may change in every cycle, at any moment of a step; jumps between sets are taken out
  /// by the caller (blend).
  void update(const world::BodyState& body, const WalkParameters& parameters, const WalkCommand& command,
              JointTargets& targets);

  /// The joint angles of its stand (head joints 0).
  static model::JointArray standAngles(const model::RobotModel& model, const WalkParameters& parameters);

  /// Stands with both feet on the ground.
  void reset();
  bool standing() const { return gait_.state().standing; }
  const GaitState& gait() const { return gait_.state(); }
  const WalkMeasurement& measurement() const { return measurement_; }
  const WalkTrace& trace() const { return trace_; }
  /// Commanded, of the walk frame: m/s, rad/s.
  Pose2 speed() const;
  /// Commanded change of the walk frame in the last cycle.
  const Pose2& odometryStep() const { return gait_.odometryStep(); }

 private:
  void moveGait(const WalkParameters& parameters, const world::BodyState& body, const WalkCommand& command,
                const Tilt& lastTilt);
  void footPoses(const WalkParameters& parameters, FootPoses& feet) const;
  void moveArms(const WalkPostureParameters& parameters, model::JointArray& angles) const;
  void straightenToes(model::JointArray& angles) const;
  void measureCom(const world::BodyState& body, const WalkParameters& parameters,
                  const model::JointArray& commanded);

  const model::RobotModel* model_;
  RunParameters run_;
  Gait gait_;
  WalkMeasurement measurement_;
  Vector3 p_TCom_ = Vector3::Zero();  // commanded centre of mass from the torso, upright axes, m
  CommandHistory history_;
  model::BodyPoses commandedBodies_{};
  WalkTrace trace_;
};

}  // namespace nonet::motion
