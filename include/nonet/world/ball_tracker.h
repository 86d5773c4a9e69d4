// The ball in the field frame: a Kalman filter over position and velocity with the law of ball_law.h.
//
// Needs: own pose with covariance, the vision message, team mates' reports. Gives: BallState.
// The horizontal and the vertical motion are filtered apart. A sighting that does not fit (a kick, a referee)
// opens the velocity or restarts the filter. What is not seen grows uncertain, faster than physics would
// have it, because somebody may kick; what should be in sight and is not seen is given up.
#pragma once

#include "nonet/protocol/percept.h"
#include "nonet/world/ball_law.h"
#include "nonet/world/world_state.h"

namespace nonet::world {

class BallTracker {
 public:
  /// A team mate's view, already turned into the own field frame.
  struct Report {
    Vector2 p_FB = Vector2::Zero();  // m
    Vector2 v_FB = Vector2::Zero();  // m/s
    double seenAt = kNever;          // server time of the mate's sighting, s
    double toldAt = kNever;          // server time at which the ball was there, s: not before it was seen
    double sigma = 0.5;              // m
    double landsIn = 0.0;            // s after it was told; 0: it rolled
  };

  void predict(double dt);
  /// `offset`: constant offset of the own camera, m.
  void see(const protocol::Vision& vision, const SelfState& self, const Vector3& offset, double time);
  void hear(const Report& report, double time);
  /// The referee holds the ball here; who sees it knows better.
  void hold(const Vector2& p_FB, double time);
  /// The referee is about to put the ball here, wherever it is seen.
  void put(const Vector2& p_FB, double time);
  /// The own team changed its side: half a turn.
  void mirror();

  void fill(BallState& state, const SelfState& self, double time) const;

 private:
  using State = Eigen::Vector4d;  // x, y, vx, vy
  using StateMatrix = Eigen::Matrix4d;

  static BallMotion reported(const Report& report, double age);
  BallMotion motion() const;
  void setMotion(const BallMotion& motion);
  void start(const Vector3& p_FB, const Matrix2& covariance);
  void rest(const Vector2& p_FB, double sigma, double time);
  void measure(const Vector3& p_FB, const Matrix3& covariance, double time);
  double kalman(const Vector2& measured, const Matrix2& covariance);
  double mismatch(const Vector2& measured, const Matrix2& covariance) const;
  void kicked(double within);
  void measureHeight(double z, double variance);

  bool started_ = false;
  State state_ = State::Zero();
  StateMatrix covariance_ = StateMatrix::Identity();
  double height_ = kBallRestHeight;
  double lift_ = 0.0;  // vertical speed, m/s
  Matrix2 heightCovariance_ = Matrix2::Identity();
  double lastSeen_ = kNever;
  double lastReported_ = kNever;
  double lastKick_ = kNever;
  double lastFit_ = kNever;   // of a sighting of a ball that nobody had kicked
  double missedAt_ = kNever;  // it should have been in sight and was not
  double sinceSeen_ = 0.0;    // s
  int absences_ = 0;          // vision frames in a row in which it should have been seen
};

}  // namespace nonet::world
