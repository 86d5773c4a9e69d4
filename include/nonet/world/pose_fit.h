// The fit: sharpens a belief about the torso's full pose with one vision frame.
//
// Needs: a belief (pose, camera offset, drift, covariance), the camera's pose in the torso, the observations.
// Gives: the most probable belief and its covariance, and how well everything agreed.
//
// A weighted nonlinear least-squares problem, solved by Gauss-Newton with step halving on fixed-size matrices
// (no allocation): minimise  d^T P^-1 d + sum |S (u - u^)|^2  over the twelve states, where d is the distance
// from the prior belief, u an observed point in camera axes, S its whitener and
//   u^ = R_WC^T (p_WP - p_WC) + e      (server facts 2.7; e is the constant offset of this robot's camera).
// Landmarks count in three directions. Line ends count in three where the true end of the line was seen, and
// in the two across the line where the view cuts it. At the optimum the covariance is the inverse of the
// normal matrix (Laplace). A Ceres version of the same problem is the oracle in the tests.
#pragma once

#include "nonet/world/field_map.h"
#include "nonet/world/vision_frame.h"

namespace nonet::world {

/// Order of the error states: position of the torso (m, W), orientation (rotation vector, rad, applied from
/// the left in W), camera offset (m, camera axes), drift (velocity that the body state misses, m/s, W).
inline constexpr int kPositionState = 0;
inline constexpr int kRotationState = 3;
inline constexpr int kOffsetState = 6;
inline constexpr int kDriftState = 9;
inline constexpr int kBeliefStates = 12;
using BeliefMatrix = Eigen::Matrix<double, kBeliefStates, kBeliefStates>;
using BeliefVector = Eigen::Matrix<double, kBeliefStates, 1>;

struct PoseBelief {
  Vector3 p_WR = Vector3::Zero();
  Matrix3 R_WR = Matrix3::Identity();
  Vector3 offset = Vector3::Zero();
  Vector3 drift = Vector3::Zero();
  BeliefMatrix covariance = BeliefMatrix::Identity();

  Pose3 pose() const;    // X_WR
  Pose2 ground() const;  // position and heading of the torso
};

struct FitSettings {
  bool useLandmarks = true;
  bool useLines = true;
  int iterations = 3;
};

struct FitReport {
  int landmarks = 0;  // used
  int lines = 0;      // matched and used
  int residuals = 0;  // scalar measurements
  double cost = 0.0;  // at the optimum: prior and measurements, in squared sigmas (chi-squared with
                      // `residuals` degrees of freedom if all is well)
  double measurementCost = 0.0;  // the part of the measurements
  double logVolume = 0.0;        // 1/2 log det(prior covariance) - 1/2 log det(posterior covariance)
  bool ok = false;               // at least one measurement, and finite numbers
};

class PoseFit {
 public:
  /// Updates `belief` in place. Lines are matched to the map first with the prior belief and again with the
  /// belief after the landmarks.
  FitReport update(PoseBelief& belief, const Pose3& X_RC, const VisionFrame& frame, const FieldMap& map,
                   const FitSettings& settings = {});

  /// Map line that the i-th observed line was matched to in the last update, or -1.
  int match(std::size_t i) const { return matches_[i]; }

 private:
  struct Problem;
  void matchLines(const Problem& problem);
  double linearise(Problem& problem) const;
  double solve(Problem& problem, int iterations) const;

  std::array<int, VisionFrame::kMaximumLines> matches_{};
};

}  // namespace nonet::world
