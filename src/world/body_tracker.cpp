#include "nonet/world/body_tracker.h"

#include <algorithm>
#include <cmath>

#include "nonet/math/angle.h"
#include "nonet/math/rotation.h"

namespace nonet::world {

namespace {

constexpr int kSleepRepeats = 5;           // identical messages until the robot counts as asleep
constexpr double kFootErrorCycles = 10.0;  // the errors of the feet's velocity go together for so many cycles
constexpr int kLongGap = 10;               // lost messages over which nothing is integrated
constexpr double kHeightToSpeed = 2.0;     // 1/s, gain from an error of the height to the vertical velocity
constexpr double kMinimumLoad = 2.0;       // N on a foot before its kinematics count

std::size_t at(model::Side side) {
  return static_cast<std::size_t>(side);
}
model::BodyId footOf(std::size_t side) {
  return side == at(model::Side::Left) ? model::BodyId::LFoot : model::BodyId::RFoot;
}

/// The rotation of one physics step with angular velocity w (rad/s). ODE adds w/2 * q * dt to the quaternion
/// q and normalises it, which turns by 2 atan(|w| dt / 2).
Matrix3 stepRotation(const Vector3& w, double dt) {
  const Eigen::Quaterniond turn(1.0, 0.5 * w.x() * dt, 0.5 * w.y() * dt, 0.5 * w.z() * dt);
  return turn.normalized().toRotationMatrix();
}

double tiltOf(const Matrix3& R) {
  return std::acos(std::clamp(R(2, 2), -1.0, 1.0));
}

}  // namespace

BodyTracker::BodyTracker(const model::RobotModel& model, const WorldParameters& parameters)
    : model_(&model), parameters_(parameters) {
  covariance_ << 0.01, 0.0, 0.0, 1e-4;
}

bool BodyTracker::update(const protocol::Percept& percept, BodyState& state) {
  const int cycles = clock_.cyclesUntil(percept.time);
  if (cycles == 0) return false;
  const double dt = cycles * kCycleTime;
  state.time = percept.time;
  state.cycleTime = dt;
  state.putUpright = false;
  readJoints(percept, dt, state);
  model::forwardKinematics(*model_, state.joints, state.bodies);
  state.p_RCom = model::centerOfMass(*model_, state.bodies);
  readForces(percept, state);
  updateSleep(percept, state);

  const Matrix3 R_before = state.R_GR;
  const Vector3 p_before = state.p_GR;
  integrateOrientation(cycles, state);
  const KinematicVelocity kinematic = first_ ? KinematicVelocity{} : footVelocity(state, dt);
  integrateVelocity(cycles, kinematic, state);
  levelByAccelerometer(state);
  updateAngles(state);
  updateHeight(state);
  updatePosture(state);

  const Pose2 before(p_before.head<2>(), yawOf(R_before));
  const Pose2 now(state.p_GR.head<2>(), yawOf(state.R_GR));
  state.odometryStep = before.inverse() * now;
  state.odometry = state.odometry * state.odometryStep;

  previousR_GR_ = state.R_GR;
  previousGyro_ = state.gyro;
  for (std::size_t side = 0; side < 2; ++side) previousFeet_[side] = state.bodies[index(footOf(side))];
  previousContact_ = state.footContact;
  previousKinematic_ = kinematic;
  first_ = false;
  return true;
}

void BodyTracker::readJoints(const protocol::Percept& percept, double dt, BodyState& state) {
  for (std::size_t i = 0; i < model::kJointCount; ++i) {
    if (((percept.jointsPresent >> i) & 1U) == 0 || !std::isfinite(percept.joints[i])) continue;
    state.jointSpeeds[i] = first_ ? 0.0 : (percept.joints[i] - state.joints[i]) / dt;
    state.joints[i] = percept.joints[i];
  }
  // The server may send "nan" (server facts 1.5): what was there stays.
  if (percept.gyro.allFinite()) state.gyro = percept.gyro;
  if (percept.accelerometer.allFinite()) state.accelerometer = percept.accelerometer;
}

void BodyTracker::readForces(const protocol::Percept& percept, BodyState& state) {
  using protocol::ForceSensor;
  for (std::size_t side = 0; side < 2; ++side) {
    const bool left = side == at(model::Side::Left);
    const auto& foot =
        percept.forces[static_cast<std::size_t>(left ? ForceSensor::LFoot : ForceSensor::RFoot)];
    const auto& toe = percept.forces[static_cast<std::size_t>(left ? ForceSensor::LToe : ForceSensor::RToe)];
    const Pose3& X_RF = state.bodies[index(footOf(side))];
    state.footContact[side] = foot.has_value() || toe.has_value();
    // Foot and toe add up: forces in the foot's axes, centres weighted by the size of the force, as the
    // server weights single contact points (server facts 2.6).
    Vector3 force = Vector3::Zero();
    Vector3 moment = Vector3::Zero();
    double weight = 0.0;
    const auto add = [&](const protocol::FootForce& part, const Pose3& X_FP) {
      if (!part.force.allFinite() || !part.center.allFinite()) return;
      const Vector3 inFoot = X_FP.linear() * part.force;
      const double size = std::max(inFoot.norm(), 1e-3);
      force += inFoot;
      moment += size * (X_FP * part.center);
      weight += size;
    };
    if (foot) add(*foot, Pose3::Identity());
    if (toe && model_->hasToes()) {
      const Pose3& X_RT = state.bodies[index(left ? model::BodyId::LToe : model::BodyId::RToe)];
      add(*toe, X_RF.inverse() * X_RT);
    }
    state.footForce[side] = force;
    if (weight > 0.0) {
      contactPoint_[side] = moment / weight;
    }
  }
}

void BodyTracker::updateSleep(const protocol::Percept& percept, BodyState& state) {
  const bool same = !first_ && percept.joints == lastJoints_ && percept.gyro == lastGyro_ &&
                    percept.accelerometer == lastAccelerometer_;
  repeats_ = same ? repeats_ + 1 : 0;
  state.asleep = repeats_ >= kSleepRepeats;
  lastJoints_ = percept.joints;
  lastGyro_ = percept.gyro;
  lastAccelerometer_ = percept.accelerometer;
}

void BodyTracker::integrateOrientation(int cycles, BodyState& state) {
  if (first_) {
    // A log may begin in the middle: take the tilt from the accelerometer when there is one.
    if (state.accelerometer.norm() > 0.5 * kGravity) {
      state.R_GR =
          Eigen::Quaterniond::FromTwoVectors(state.accelerometer, Vector3::UnitZ()).toRotationMatrix();
    }
    return;
  }
  // Asleep: the frozen senses still show the last, tiny rate. A long gap: nothing is known of it.
  if (state.asleep || cycles > kLongGap) return;
  for (int i = 1; i <= cycles; ++i) {
    const double share = static_cast<double>(i) / cycles;
    const Vector3 rate = (1.0 - share) * previousGyro_ + share * state.gyro;
    state.R_GR = state.R_GR * stepRotation(rate, kCycleTime);
  }
  // Keep it a rotation: one Newton step towards the nearest orthonormal matrix.
  state.R_GR = 0.5 * state.R_GR * (3.0 * Matrix3::Identity() - state.R_GR.transpose() * state.R_GR);
}

void BodyTracker::levelByAccelerometer(BodyState& state) {
  // Only for a robot at rest: there the accelerometer points up. It is one cycle old, so it is compared with
  // the orientation of that cycle.
  const double size = state.accelerometer.norm();
  const double busy = state.gyro.norm() + previousGyro_.norm();
  if (first_ || std::abs(size - kGravity) > 0.1 || busy > 0.02) {
    tiltMismatches_ = 0;
    return;
  }
  const Vector3 up_G = previousR_GR_ * (state.accelerometer / size);
  const Vector3 error = up_G.cross(Vector3::UnitZ());
  tiltMismatches_ = error.norm() > 0.02 ? tiltMismatches_ + 1 : 0;
  const double gain = tiltMismatches_ > 5 ? 0.3 : 0.01;  // large: somebody else put the robot upright
  state.R_GR = exponential(gain * error) * state.R_GR;
}

BodyTracker::KinematicVelocity BodyTracker::footVelocity(const BodyState& state, double dt) const {
  // The material point of the foot under the centre of pressure rests on the ground: what it seems to move
  // in the torso's frame is the motion of the torso. Both feet count by their load.
  KinematicVelocity result;
  double activity = 0.0;
  for (std::size_t side = 0; side < 2; ++side) {
    const double load = state.footForce[side].norm();
    if (!state.footContact[side] || !previousContact_[side] || load < kMinimumLoad) continue;
    const Vector3& p_FP = contactPoint_[side];
    const Vector3 before = previousR_GR_ * (previousFeet_[side] * p_FP);
    const Vector3 now = state.R_GR * (state.bodies[index(footOf(side))] * p_FP);
    const Vector3 v_GR = (before - now) / dt;
    result.v_GR += load * v_GR;
    result.load += load;
    activity += load * v_GR.norm();
  }
  if (result.load <= 0.0) return {};
  result.v_GR /= result.load;
  // Feet slip and roll over their edges; how much grows with the speed (compared with the recorded walks).
  result.sigma = 0.003 + 0.3 * activity / result.load + 0.03 * state.gyro.norm();
  return result;
}

void BodyTracker::integrateVelocity(int cycles, const KinematicVelocity& kinematic, BodyState& state) {
  if (first_) return;
  const double dt = cycles * kCycleTime;
  if (state.asleep) {
    settledVelocity_.setZero();
    covariance_(0, 0) = 1e-6;
    covariance_(0, 1) = covariance_(1, 0) = 0.0;
    state.v_GR.setZero();
    settledPosition_ = state.p_GR;
    return;
  }
  if (cycles > kLongGap) {
    settledVelocity_.setZero();
    state.v_GR.setZero();
    settledPosition_ = state.p_GR;
    covariance_ << 0.25, 0.0, 0.0, 0.01;
    return;
  }
  // ACC = R^T ((v - v_before)/dt - g), one cycle old (server facts 2.6).
  const Vector3 acceleration = previousR_GR_ * state.accelerometer - Vector3(0.0, 0.0, kGravity);
  settledVelocity_ += acceleration * dt;
  // Printing adds 5.8e-5 m/s and 1e-6 rad per cycle. A cycle that was lost adds much more.
  Matrix2 F;
  F << 1.0, kGravity * dt, 0.0, 1.0;
  covariance_ = F * covariance_ * F.transpose();
  covariance_(0, 0) += 1e-8 * cycles + (cycles > 1 ? 0.04 : 0.0);
  covariance_(1, 1) += 4e-12 * cycles + (cycles > 1 ? 1e-6 : 0.0);
  if (previousKinematic_.load > 0.0) correctByFeet(state);
  settledPosition_ += settledVelocity_ * dt;
  if (previousGrounded_) {
    // The legs measure the height better than any velocity: they hold position and velocity in z.
    const double innovation = previousHeight_ - settledPosition_.z();
    settledPosition_.z() += (isFallen(state.posture) ? 0.1 : 0.4) * innovation;
    settledVelocity_.z() += kHeightToSpeed * innovation;
  }
  state.v_GR = settledVelocity_;
  if (kinematic.load > 0.0 && previousKinematic_.load > 0.0) {
    // The change of this last cycle is not measured yet; the legs tell most of it.
    Vector3 change = kinematic.v_GR - previousKinematic_.v_GR;
    const double size = change.norm();
    if (size > 0.1) change *= 0.1 / size;
    state.v_GR += 0.5 * change;
  }
  state.p_GR = settledPosition_ + state.v_GR * kCycleTime;
}

void BodyTracker::correctByFeet(BodyState& state) {
  const double variance = kFootErrorCycles * previousKinematic_.sigma * previousKinematic_.sigma;
  const Vector3 innovation = previousKinematic_.v_GR - settledVelocity_;
  // A long disagreement means that the robot was put upright or moved by somebody else.
  const double share = innovation.head<2>().squaredNorm() / (covariance_(0, 0) + variance);
  disagreement_ += 0.1 * (share - disagreement_);
  if (disagreement_ > 2.0) {
    covariance_ += Vector2(0.01, 1e-4).asDiagonal();
    disagreement_ = 0.0;
  }
  const double expected = covariance_(0, 0) + variance;
  const Vector2 gain = covariance_.col(0) / expected;
  settledVelocity_.head<2>() += gain.x() * innovation.head<2>();
  // exp(d) R a = R a + d x (R a), and R a is mostly (0, 0, g): a tilt error d about y adds g d to x.
  const Vector3 tilt(-gain.y() * innovation.y(), gain.y() * innovation.x(), 0.0);
  state.R_GR = exponential(tilt) * state.R_GR;
  previousR_GR_ = exponential(tilt) * previousR_GR_;
  const Matrix2 joseph = Matrix2::Identity() - gain * Eigen::RowVector2d(1.0, 0.0);
  covariance_ = joseph * covariance_ * joseph.transpose() + variance * gain * gain.transpose();
}

void BodyTracker::correctTilt(const Vector3& rotation, BodyState& state) {
  const Matrix3 turn = exponential(Vector3(rotation.x(), rotation.y(), 0.0));
  state.R_GR = turn * state.R_GR;
  previousR_GR_ = turn * previousR_GR_;
  updateAngles(state);
}

void BodyTracker::putUpright(BodyState& state) {
  state.putUpright = true;
  if (state.posture == Posture::Upright) return;
  state.R_GR = turnAboutZ(yawOf(state.R_GR));
  previousR_GR_ = state.R_GR;
  settledVelocity_.setZero();
  state.v_GR.setZero();
  covariance_ << 0.01, 0.0, 0.0, 1e-4;
  previousKinematic_ = {};
  disagreement_ = 0.0;
  tiltMismatches_ = 0;
  updateAngles(state);
  updateHeight(state);
  updatePosture(state);
}

void BodyTracker::updateAngles(BodyState& state) const {
  state.yaw = yawOf(state.R_GR);
  state.pitch = std::asin(std::clamp(-state.R_GR(2, 0), -1.0, 1.0));
  state.roll = std::atan2(state.R_GR(2, 1), state.R_GR(2, 2));
}

double BodyTracker::lowestPoint(const BodyState& state) const {
  // Feet by the corners of their soles; when the robot lies, every body by its half extents.
  double lowest = 0.0;
  const bool lying = isFallen(state.posture);
  for (const model::BodySpec& body : model_->bodies()) {
    const bool foot = body.id == model::BodyId::LFoot || body.id == model::BodyId::RFoot ||
                      body.id == model::BodyId::LToe || body.id == model::BodyId::RToe;
    if (!body.collider || (!foot && !lying)) continue;
    const Pose3& X_RB = state.bodies[index(body.id)];
    const Eigen::RowVector3d up = state.R_GR.row(2);
    const double center = up.dot(X_RB.translation());
    double reach = body.shape.size.x();  // sphere and capsule: the radius is enough here
    if (body.shape.kind == model::ShapeKind::Box) {
      reach = 0.5 * (up * X_RB.linear()).cwiseAbs().dot(body.shape.size.transpose());
    }
    lowest = std::min(lowest, center - reach);
  }
  return lowest;
}

void BodyTracker::updateHeight(BodyState& state) {
  const double onGround = -lowestPoint(state);
  const bool contact = state.footContact[0] || state.footContact[1] || isFallen(state.posture);
  // In the air the inertial estimate carries on, but never puts a foot below the ground.
  state.torsoHeight = contact || first_ ? onGround : std::max(onGround, state.p_GR.z());
  if (first_) state.p_GR.z() = settledPosition_.z() = onGround;
  previousHeight_ = onGround;
  previousGrounded_ = contact;
}

void BodyTracker::updatePosture(BodyState& state) {
  const double tilt = tiltOf(state.R_GR);
  // Rate of the tilt: the part of the gyro about the horizontal axis of the tilt.
  const Vector3 up_R = state.R_GR.row(2).transpose();
  const Vector3 axis = up_R.cross(Vector3::UnitZ());
  const double rate = axis.norm() > 0.05 ? state.gyro.dot(axis.normalized()) : 0.0;
  const double preview = tilt + parameters_.fallPreview * rate;
  Posture posture = state.posture;
  if (first_ || tilt < parameters_.uprightAngle) uprightAt_ = state.time;
  const bool leans = !isFallen(posture) && state.time - uprightAt_ > parameters_.longestLean;
  if (tilt > parameters_.fallenAngle || leans) {
    // The direction stays as it was unless it is clearly another: lying half on the side must not flicker.
    const double ahead = -up_R.x();  // > 0: face down
    const double left = -up_R.y();   // > 0: left side down
    const bool sideways =
        std::abs(left) >
        std::abs(ahead) * (posture == Posture::FallenLeft || posture == Posture::FallenRight ? 0.8 : 1.25);
    if (sideways) {
      posture = left > 0.0 ? Posture::FallenLeft : Posture::FallenRight;
    } else {
      posture = ahead > 0.0 ? Posture::FallenFront : Posture::FallenBack;
    }
  } else if (posture == Posture::Upright) {
    if (preview > parameters_.fallingAngle && tilt > 0.2) posture = Posture::Falling;
  } else if (tilt < parameters_.uprightAngle && std::abs(preview) < parameters_.fallingAngle) {
    posture = Posture::Upright;
  }
  if (posture != state.posture || first_) state.postureSince = state.time;
  state.posture = posture;
}

}  // namespace nonet::world
