// The omnidirectional walk: a double linear inverted pendulum after [Graf 2009], with the parameters of
// [MacAlpine 2012b].
//
// Needs: a parameter set, the wanted speed, the measured body. Gives: both foot poses, through the inverse
// kinematics the leg joints, and the arms.
//
// All planning happens in the walk frame W: on the ground below the undisturbed torso, x forward, moving with
// the commanded speed. The stance foot stands still on the ground, so in W it moves backwards; the swing foot
// goes to where half a step ahead of W will be when it lands. Over the stance foot the torso swings on the
// orbit of a linear pendulum; both orbits meet at the change of feet, in position and velocity (no double
// support).
#pragma once

#include <array>

#include "nonet/math/pose2.h"
#include "nonet/motion/limbs.h"
#include "nonet/motion/request.h"
#include "nonet/motion/walk_parameters.h"
#include "nonet/world/body_state.h"

namespace nonet::motion {

/// What the engine planned in the last cycle, for plots and tests.
struct WalkTrace {
  double phase = 0.0;  // share of the step that is over, (0, 1]
  model::Side stance = model::Side::Left;
  Pose2 step;                                // step size in force, m, m, rad
  FootPoses feet{};                          // X_RS as commanded
  Vector3 p_SComDesired = Vector3::Zero();   // centre of mass over the stance foot as commanded, delayed, m
  Vector3 p_SComMeasured = Vector3::Zero();  // the same as measured
  double comError = 0.0;                     // m
  double pitchError = 0.0;                   // rad
  double rollError = 0.0;                    // rad
  double torsoYaw = 0.0;                     // of the measured torso in the walk frame, rad
  model::Reach reach = model::Reach::Exact;
};

class WalkEngine {
 public:
  explicit WalkEngine(const model::RobotModel& model);

  /// One cycle. `speed` in m/s, m/s, rad/s is the wish; the engine shrinks it to what the set allows. `walk`
  /// false: come to a stand. The set may change in every cycle, at any moment of a step; jumps between sets
  /// are taken out by the caller (blend).
  void update(const world::BodyState& body, const WalkParameters& parameters, const Pose2& speed, bool walk,
              JointTargets& targets);

  /// Duration of one step in whole cycles, s.
  static double stepTime(const WalkParameters& parameters);

  /// The joint angles of its stand (head joints 0).
  static model::JointArray standAngles(const model::RobotModel& model, const WalkParameters& parameters);

  /// Stands with both feet on the ground.
  void reset();
  bool standing() const { return mode_ == Mode::Standing; }
  const WalkTrace& trace() const { return trace_; }
  /// Commanded change of the walk frame in the last cycle.
  const Pose2& odometryStep() const { return odometryStep_; }

 private:
  enum class Mode : std::uint8_t { Standing, Walking, Stopping };
  struct Tilt {
    double pitch = 0.0;
    double pitchRate = 0.0;
    double roll = 0.0;
    double rollRate = 0.0;
  };

  struct Lean {
    double pitch = 0.0;
    double roll = 0.0;
  };

  void advancePhase(double cycleTime, bool walk, const Pose2& speed, const Tilt& tilt);
  void updateStepSize(double cycles, const Pose2& speed, bool walk);
  void updateAcceleration(const Vector2& stepChange, double cycles);
  Lean lean() const;
  double torsoYaw() const;
  void moveFrame(double cycleTime);
  void moveSwingFoot(const Tilt& tilt);
  void placeFeet();
  Vector2 pendulumOffset() const;
  double lift() const;
  Tilt tiltError(const world::BodyState& body) const;
  void footPoses(const Tilt& tilt, FootPoses& feet) const;
  void moveArms(model::JointArray& angles) const;
  void measureComError(const world::BodyState& body, const model::JointArray& commanded);
  double stepTime() const { return stepTime(parameters_); }

  const model::RobotModel* model_;
  WalkParameters parameters_;
  Mode mode_ = Mode::Standing;
  double phase_ = 1.0;
  model::Side stance_ = model::Side::Left;
  Pose2 wanted_;                            // step size filtered, m, m, rad
  Pose2 step_;                              // the same after the brake for errors
  Vector2 acceleration_ = Vector2::Zero();  // as commanded, filtered, m/s^2
  std::array<Pose2, 2> feet_;               // X_WS, soles on the ground plane
  Pose2 swingStart_;                        // X_WS of the swing foot at the begin of the step
  bool feetPlaced_ = false;
  int stepsDone_ = 0;     // since the stand
  int stepsInPlace_ = 0;  // consecutive, while stopping
  Pose2 odometryStep_;
  Vector3 comOffset_ = Vector3::Zero();  // commanded centre of mass in the torso frame, m
  static constexpr std::size_t kHistory = 8;
  std::array<Vector3, kHistory> expectedCom_{};  // over the stance foot of that cycle, m
  std::array<model::Side, kHistory> expectedStance_{};
  std::array<double, kHistory> expectedYaw_{};  // rad
  std::size_t historySize_ = 0;
  std::size_t historyEnd_ = 0;
  model::BodyPoses commandedBodies_{};
  WalkTrace trace_;
};

}  // namespace nonet::motion
