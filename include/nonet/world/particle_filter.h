// Monte Carlo localization over the ground pose (x, y, heading) in W: holds hypotheses and decides between
// them.
//
// After [Thrun 2005, chapter 8]: prediction by odometry, weights from landmarks and lines, low-variance
// resampling when the effective sample size drops (table 4.4), and re-seeding from sensor geometry when the
// observations fit badly (augmented MCL, section 8.3.5, and sensor resetting). Many particles while lost, few
// while tracking.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "nonet/math/pose2.h"
#include "nonet/math/random.h"
#include "nonet/world/field_map.h"
#include "nonet/world/vision_frame.h"

namespace nonet::world {

struct Particle {
  Pose2 X_WR;
  double logWeight = 0.0;
};

/// What the filter needs of a vision frame: everything in level axes with the torso's heading, origin below
/// the torso (frame L), projected on the ground.
struct GroundObservations {
  struct Point {
    protocol::Landmark id = protocol::Landmark::F1L;
    Vector2 p_LP = Vector2::Zero();
    double information = 0.0;  // 1 / variance of either coordinate, 1/m^2
  };
  struct Segment {
    std::array<Vector2, 2> ends{Vector2::Zero(), Vector2::Zero()};
    std::array<double, 2> information{};
    double length = 0.0;
    std::array<bool, 2> clipped{};
    std::uint32_t candidates = 0;  // bit per map line that is long enough
  };
  std::array<Point, VisionFrame::kMaximumLandmarks> landmarks;
  std::size_t landmarkCount = 0;
  std::array<Segment, VisionFrame::kMaximumLines> lines;
  std::size_t lineCount = 0;

  /// X_LC: camera in level axes; `offset`: the constant offset of the camera.
  void assign(const VisionFrame& frame, const Pose3& X_LC, const Vector3& offset, const FieldMap& map,
              bool useLines);
  std::span<const Point> points() const { return {landmarks.data(), landmarkCount}; }
  std::span<const Segment> segments() const { return {lines.data(), lineCount}; }
};

class ParticleFilter {
 public:
  static constexpr std::size_t kMany = 240;  // while lost
  static constexpr std::size_t kFew = 24;    // while tracking

  explicit ParticleFilter(std::uint64_t seed);

  /// Spreads all particles over the field.
  void scatter(const FieldMap& map);

  void predict(const Pose2& X_step, double distanceNoise, double angleNoise);

  /// Weighs, resamples and re-seeds. `tracking`: the fit is sure of its pose, so few particles are enough.
  void correct(const GroundObservations& seen, const FieldMap& map, bool tracking);

  /// Replaces the lightest particle.
  void insert(const Pose2& X_WR);

  /// Log-likelihood of the observations at a pose. The cost of each observation is bounded, so that one
  /// outlier does not rule a pose out.
  double logLikelihood(const Pose2& X_WR, const GroundObservations& seen, const FieldMap& map) const;

  /// The heaviest clusters, heaviest first; at most three.
  struct Cluster {
    Pose2 X_WR;
    double share = 0.0;  // of the total weight
  };
  std::span<const Cluster> clusters() const { return {clusters_.data(), clusterCount_}; }
  std::span<const Particle> particles() const { return particles_; }
  /// Spread of the heaviest cluster.
  const Eigen::Matrix3d& covariance() const { return covariance_; }

 private:
  void resample(std::size_t count);
  Pose2 seed(const GroundObservations& seen, const FieldMap& map);
  void findClusters();

  Random random_;
  std::vector<Particle> particles_;  // reserved once
  std::vector<Particle> next_;
  std::vector<double> weights_;
  std::array<Cluster, 3> clusters_;
  std::size_t clusterCount_ = 0;
  double effectiveSize_ = 0.0;
  double slowFit_ = 0.0;  // long-term mean likelihood per observation
  double fastFit_ = 0.0;  // short-term
  Matrix3 covariance_ = Matrix3::Identity();
};

}  // namespace nonet::world
