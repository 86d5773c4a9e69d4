// Where the robot is: body state and vision -> belief about the torso's full pose in the world frame W.
//
// Who does what. The body state moves the belief from frame to frame. The particle filter (ground pose only)
// holds several hypotheses and decides between them: at the start, after a kidnap, when only lines are in
// sight. The fit (all six degrees of freedom, camera offset and drift) sharpens the chosen hypothesis with
// every landmark and line end of a vision frame and tells the covariance. When the fit disagrees with its
// prior beyond what the noise allows, the robot was moved by somebody else: the prior is widened, or the pose
// is taken from the landmarks alone, or the particle filter is asked.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "nonet/math/random.h"
#include "nonet/world/body_state.h"
#include "nonet/world/field_map.h"
#include "nonet/world/particle_filter.h"
#include "nonet/world/pose_fit.h"
#include "nonet/world/vision_frame.h"

namespace nonet::world {

struct LocalizationSettings {
  bool useFilter = true;  // false: the fit alone, started from landmark geometry
  bool useFit = true;     // false: the particle filter alone
  bool useLines = true;
};

class Localization {
 public:
  Localization(std::uint64_t seed, const LocalizationSettings& settings = {});

  /// Moves the belief with the body, then corrects it with what was seen (nullptr: nothing in this cycle).
  void update(const BodyState& body, const protocol::Vision* vision);

  /// The robot has probably been put at one of these places (W), upright, with the server's beam noise. They
  /// are hypotheses: taken when what is seen fits one of them and not the present belief. At most two; that
  /// is for a robot that does not know on which side it plays.
  void expectPlaces(std::span<const Pose2> X_WR, double time);

  const FieldMap& map() const { return *map_; }
  const PoseBelief& belief() const { return belief_; }
  bool initialised() const { return initialised_; }
  double lastCorrection() const { return lastCorrection_; }
  /// Server time of the last correction with a landmark: lines alone look alike from several places.
  double lastLandmark() const { return lastLandmark_; }
  /// Rotation vector in G by which the body's torso orientation was found wrong in the last update; to be fed
  /// back to the body tracker.
  const Vector3& tiltCorrection() const { return tiltCorrection_; }
  const FitReport& report() const { return report_; }
  const ParticleFilter& particles() const { return particles_; }

 private:
  void predict(const BodyState& body);
  void measureHeight(const BodyState& body);
  void correct(const BodyState& body, const protocol::Vision& vision);
  bool track(const BodyState& body);
  bool relocate(const BodyState& body);
  PoseBelief movedBelief(double positionSigma, double headingSigma) const;
  std::optional<PoseBelief> shiftedByLandmarks(const BodyState& body) const;
  std::optional<PoseBelief> fromLandmarks(const BodyState& body, bool upright) const;
  PoseBelief wideBelief(const Pose2& X_WR, double positionSigma, double headingSigma,
                        const BodyState& body) const;
  bool tryExpectations(const BodyState& body);
  bool tryFit(PoseBelief belief, const BodyState& body);
  bool plausible(const FitReport& report) const;
  void adopt(const PoseBelief& belief, const BodyState& body);
  void detectField();
  bool challenged();
  void followFilter(const BodyState& body);

  static constexpr int kPatience = 10;  // vision frames that may fail before the belief is given up

  LocalizationSettings settings_;
  FieldMap large_;
  FieldMap small_;
  const FieldMap* map_;
  double fieldEvidence_ = 0.0;  // log-likelihood ratio small : large
  PoseFit fit_;
  VisionFrame frame_;
  ParticleFilter particles_;
  GroundObservations ground_;
  PoseBelief belief_;
  FitReport report_;
  bool initialised_ = false;
  double yawOffset_ = 0.0;  // heading of G in W, rad
  Vector3 lastP_GR_ = Vector3::Zero();
  bool hasLast_ = false;
  double pace_ = 0.0;  // m/s, horizontal speed of the last half second
  Pose2 step_;         // odometry since the last vision frame
  int misses_ = 0;
  double moveSigma_ = 0.2;         // m, size of the recent moves by others
  double moveHeadingSigma_ = 0.3;  // rad
  double lastCorrection_ = kNever;
  double lastLandmark_ = kNever;
  Vector3 tiltCorrection_ = Vector3::Zero();
  std::array<Pose2, 2> expectedPlaces_;
  std::size_t expectedCount_ = 0;
  double expectedSince_ = kNever;
  int challenges_ = 0;  // vision frames in a row in which the particle filter knew better
};

}  // namespace nonet::world
