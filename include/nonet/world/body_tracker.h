// Percept -> BodyState: joints, torso orientation, velocity and odometry, foot contacts, posture.
//
// Needs: gyro, accelerometer, joints and foot forces of one message. Gives: BodyState. Knows nothing of the
// field.
//
// How it works. The server's gyro and accelerometer are free of noise but for printing (server facts 2.6), so
// the torso is followed as by an inertial navigation system: the gyro is integrated with the step of the
// server's physics, and the accelerometer, which is one cycle older than the rest, gives the velocity of the
// cycle before. What drifts is held by the kinematics: a foot that stands does not move. A small Kalman
// filter compares the two velocities; their difference tells the error of the velocity and, because a tilted
// accelerometer sees a part of gravity, that of the tilt.
#pragma once

#include <array>

#include "nonet/model/robot_model.h"
#include "nonet/protocol/percept.h"
#include "nonet/protocol/server_clock.h"
#include "nonet/world/body_state.h"
#include "nonet/world/parameters.h"

namespace nonet::world {

class BodyTracker {
 public:
  BodyTracker(const model::RobotModel& model, const WorldParameters& parameters);

  /// Absorbs one message. A repeated one (same time) changes nothing and returns false.
  bool update(const protocol::Percept& percept, BodyState& state);

  /// Turns the estimate of the torso's orientation by a small rotation vector in G (its z part is ignored:
  /// the heading of G is free). Comes from the camera's fit.
  void correctTilt(const Vector3& rotation, BodyState& state);

  /// The server has put the robot onto its feet, at rest, in the cycle of the last message.
  void putUpright(BodyState& state);

 private:
  struct KinematicVelocity {
    Vector3 v_GR = Vector3::Zero();
    double load = 0.0;  // vertical force on the feet it comes from, N; 0: no contact
    double sigma = 1.0;
  };

  void readJoints(const protocol::Percept& percept, double dt, BodyState& state);
  void readForces(const protocol::Percept& percept, BodyState& state);
  void integrateOrientation(int cycles, BodyState& state);
  void levelByAccelerometer(BodyState& state);
  KinematicVelocity footVelocity(const BodyState& state, double dt) const;
  void integrateVelocity(int cycles, const KinematicVelocity& kinematic, BodyState& state);
  void correctByFeet(BodyState& state);
  void updateSleep(const protocol::Percept& percept, BodyState& state);
  void updateAngles(BodyState& state) const;
  void updateHeight(BodyState& state);
  void updatePosture(BodyState& state);
  double lowestPoint(const BodyState& state) const;

  const model::RobotModel* model_;
  WorldParameters parameters_;
  bool first_ = true;
  protocol::ServerClock clock_;
  // The previous cycle.
  Matrix3 previousR_GR_ = Matrix3::Identity();
  Vector3 previousGyro_ = Vector3::Zero();
  std::array<Pose3, 2> previousFeet_{Pose3::Identity(), Pose3::Identity()};  // X_RF, indexed by model::Side
  std::array<bool, 2> previousContact_{};
  KinematicVelocity previousKinematic_;
  // Velocity and position of the cycle before the present one: as far as the accelerometer reaches.
  Vector3 settledVelocity_ = Vector3::Zero();
  Vector3 settledPosition_ = Vector3::Zero();
  // Covariance of (velocity, tilt) for each horizontal axis, m/s and rad: the same for both axes.
  Matrix2 covariance_ = Matrix2::Identity();
  double disagreement_ = 0.0;  // smoothed, of feet and accelerometer, in units of the expected one
  double previousHeight_ = 0.0;
  double uprightAt_ = 0.0;  // the last time at which it did not lean, s
  bool previousGrounded_ = false;
  // What the last message said, to notice that nothing changes any more.
  model::JointArray lastJoints_{};
  Vector3 lastGyro_ = Vector3::Zero();
  Vector3 lastAccelerometer_ = Vector3::Zero();
  int repeats_ = 0;
  int tiltMismatches_ = 0;
  std::array<Vector3, 2> contactPoint_{Vector3::Zero(), Vector3::Zero()};  // centre of pressure, foot frame
};

}  // namespace nonet::world
