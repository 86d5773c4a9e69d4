#include "nonet/world/localization.h"

#include <algorithm>
#include <cmath>

#include "nonet/math/angle.h"
#include "nonet/math/rotation.h"

namespace nonet::world {

namespace {

// Process noise, such that the stated regions hold the truth as often as they say on the golden recordings
// and in matches on the embedded server. The body state's velocity is off by a slowly changing drift: 0.001
// m/s while standing, up to a twentieth of the speed while walking. The velocity of the newest cycle is known
// only when the accelerometer reports it, one cycle later.
constexpr double kStillDrift = 0.002;  // m/s
constexpr double kPaceDrift = 0.08;    // share of the speed
constexpr double kFreeDrift =
    0.06;  // m/s, more while falling, lying and rising, and of a robot that was moved
constexpr double kDriftTime = 3.0;      // s, correlation time of the drift
constexpr double kPaceTime = 0.5;       // s over which the speed counts
constexpr double kTiltNoise = 2e-5;     // rad per cycle, from the body tracker's own corrections
constexpr double kHeadingNoise = 1e-5;  // rad per cycle
constexpr double kHeightSigma =
    0.05;  // m, of the legs' kinematics: soft ground and tilted soles, much the same for many cycles
constexpr double kLyingHeightSigma = 0.04;  // m
// A robot that was moved: small moves (a trainer that carries it, a push by the referee) and free ones.
constexpr double kMoveSigma = 0.2;          // m
constexpr double kMoveHeadingSigma = 0.3;   // rad
constexpr double kMoveTiltSigma = 0.05;     // rad
constexpr double kMoveHeightSigma = 0.03;   // m
constexpr double kKeptHeadingSigma = 0.01;  // rad, of a robot that was shifted without being turned
constexpr double kFreeSigma = 20.0;         // m
constexpr double kFreeHeadingSigma = 2.0;   // rad

constexpr double kExpectation = 1.0;    // s for which a beam is expected to show
constexpr double kContradiction = 3.0;  // mean -log likelihood of what is seen at a pose that is wrong
constexpr double kBeamHeight = 0.4;     // m, of the torso

/// The turn about z in R = turnAboutZ(angle) * swing, where the swing axis is horizontal.
double twistAboutZ(const Matrix3& R) {
  const Eigen::Quaterniond q(R);
  return 2.0 * std::atan2(q.z(), q.w());
}

/// As the server puts robots down that are beamed (server facts 4.6).
void stand(PoseBelief& belief, double heading) {
  belief.p_WR.z() = kBeamHeight;
  belief.R_WR = turnAboutZ(heading);
}

}  // namespace

Localization::Localization(std::uint64_t seed, const LocalizationSettings& settings)
    : settings_(settings), large_(largeField()), small_(smallField()), map_(&large_), particles_(seed) {
  particles_.scatter(*map_);
  // Nothing is known but the bounds of the camera's offset.
  belief_ = wideBelief({}, kFreeSigma, kFreeHeadingSigma, BodyState{});
  const double offset = VisionNoise::kOffsetBound / std::sqrt(3.0);
  belief_.covariance.block<3, 3>(kOffsetState, kOffsetState) = Matrix3::Identity() * offset * offset;
}

void Localization::update(const BodyState& body, const protocol::Vision* vision) {
  tiltCorrection_.setZero();
  predict(body);
  if (vision != nullptr) correct(body, *vision);
}

void Localization::predict(const BodyState& body) {
  const Vector3 p_before = hasLast_ ? lastP_GR_ : body.p_GR;
  const Vector3 step = turnAboutZ(yawOffset_) * (body.p_GR - p_before);
  lastP_GR_ = body.p_GR;
  hasLast_ = true;
  step_ = step_ * body.odometryStep;
  const double dt = body.cycleTime;
  belief_.p_WR += step + dt * belief_.drift;
  belief_.R_WR = turnAboutZ(yawOffset_) * body.R_GR;

  pace_ += std::min(1.0, dt / kPaceTime) * (body.v_GR.head<2>().norm() - pace_);
  double driftSigma = kStillDrift + kPaceDrift * pace_;
  if (body.posture != Posture::Upright) driftSigma += kFreeDrift;
  if (body.asleep) driftSigma = 1e-4;
  const double keep = body.asleep ? 0.0 : std::exp(-dt / kDriftTime);
  belief_.drift *= keep;
  BeliefMatrix& P = belief_.covariance;
  // F = I + dt * d(position)/d(drift), then the drift decays by `keep`.
  P.middleRows<3>(kPositionState) += dt * P.middleRows<3>(kDriftState);
  P.middleCols<3>(kPositionState) += dt * P.middleCols<3>(kDriftState);
  P.middleRows<3>(kDriftState) *= keep;
  P.middleCols<3>(kDriftState) *= keep;
  const double shake =
      body.asleep ? 0.0 : (body.accelerometer - body.R_GR.row(2).transpose() * kGravity).norm();
  const double position = 1e-5 + 0.5 * dt * kCycleTime * shake;
  for (int i = 0; i < 3; ++i) {
    P(kPositionState + i, kPositionState + i) += position * position;
    P(kDriftState + i, kDriftState + i) += (1.0 - keep * keep) * driftSigma * driftSigma;
  }
  const double cycles = dt / kCycleTime;
  const double lost = cycles > 1.5 ? 0.01 : 0.0;  // the gyro says nothing about what was missed
  for (int i = 0; i < 3; ++i) {
    const double noise = (i < 2 ? kTiltNoise : kHeadingNoise) + lost;
    P(kRotationState + i, kRotationState + i) += noise * noise;
  }
}

void Localization::measureHeight(const BodyState& body) {
  const bool lying = isFallen(body.posture);
  if (!lying && !body.footContact[0] && !body.footContact[1]) return;
  const double sigma = lying ? kLyingHeightSigma : kHeightSigma;
  BeliefMatrix& P = belief_.covariance;
  const BeliefVector column = P.col(kPositionState + 2);
  const double expected = column(kPositionState + 2) + sigma * sigma;
  const BeliefVector gain = column / expected;
  const BeliefVector change = gain * (body.torsoHeight - belief_.p_WR.z());
  P -= gain * column.transpose();
  belief_.p_WR += change.segment<3>(kPositionState);
  belief_.offset += change.segment<3>(kOffsetState);
  belief_.drift += change.segment<3>(kDriftState);
}

void Localization::detectField() {
  // Distances between landmarks do not depend on the pose: they tell the two fields apart at once.
  const auto landmarks = frame_.landmarks();
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double measured = (landmarks[i].at.p_CP - landmarks[j].at.p_CP).norm();
      const double reach = landmarks[i].at.p_CP.norm() + landmarks[j].at.p_CP.norm();
      const double sigma = 0.05 + VisionNoise::kAzimuthSigma * reach;
      const auto error = [&](const FieldMap& map) {
        const double distance = (map.landmark(landmarks[i].id) - map.landmark(landmarks[j].id)).norm();
        return std::min(0.5 * std::pow((measured - distance) / sigma, 2), 20.0);
      };
      fieldEvidence_ += error(large_) - error(small_);
    }
  }
  fieldEvidence_ = std::clamp(fieldEvidence_, -60.0, 60.0);
  const FieldMap* chosen = map_;
  if (fieldEvidence_ > 10.0) chosen = &small_;
  if (fieldEvidence_ < -10.0) chosen = &large_;
  if (chosen != map_) {
    map_ = chosen;
    initialised_ = false;
    particles_.scatter(*map_);
  }
}

void Localization::correct(const BodyState& body, const protocol::Vision& vision) {
  frame_.assign(vision);
  detectField();
  if (initialised_) measureHeight(body);
  report_ = {};
  const Pose2 step = step_;
  step_ = {};
  if (frame_.landmarks().empty() && frame_.lines().empty()) {
    if (settings_.useFilter) particles_.predict(step, 0.01, 0.005);
    return;
  }
  if (settings_.useFilter) {
    const double heading = yawOf(body.R_GR);
    Pose3 X_LC = Pose3::Identity();
    X_LC.linear() = turnAboutZ(-heading) * body.R_GR;
    X_LC = X_LC * model::cameraPose(body.bodies);
    ground_.assign(frame_, X_LC, belief_.offset, *map_, settings_.useLines);
    const double moved = step.translation.norm();
    particles_.predict(step, 0.01 + 0.1 * moved, 0.005);
    if (initialised_ && settings_.useFit) particles_.insert(belief_.ground());
    particles_.correct(ground_, *map_, initialised_ && settings_.useFit);
  }
  if (!settings_.useFit) {
    followFilter(body);
    return;
  }
  bool good = initialised_ && track(body);
  if (good && settings_.useFilter) good = !challenged();
  if (!good) good = relocate(body);
  if (!good) {
    // Nothing fits: trust the body for a moment, but less and less.
    for (int i = 0; i < 2; ++i) belief_.covariance(kPositionState + i, kPositionState + i) += 0.05 * 0.05;
    belief_.covariance(kRotationState + 2, kRotationState + 2) += 0.02 * 0.02;
    if (++misses_ > kPatience) initialised_ = false;
  }
}

bool Localization::plausible(const FitReport& report) const {
  if (!report.ok) return false;
  const double freedom = report.residuals;
  if (report.cost > freedom + 4.0 * std::sqrt(2.0 * freedom) + 4.0) return false;
  const int seen = settings_.useLines ? static_cast<int>(frame_.lines().size()) : 0;
  return 2 * report.lines >= seen - 2;
}

bool Localization::tryFit(PoseBelief belief, const BodyState& body) {
  FitSettings settings;
  settings.useLines = settings_.useLines;
  const FitReport report = fit_.update(belief, model::cameraPose(body.bodies), frame_, *map_, settings);
  report_ = report;
  if (!plausible(report)) return false;
  adopt(belief, body);
  return true;
}

bool Localization::track(const BodyState& body) {
  if (tryFit(belief_, body)) return true;
  // Moved a little by somebody else: first as far as the last such moves, then farther.
  const PoseBelief before = belief_;
  if (!tryFit(movedBelief(moveSigma_, moveHeadingSigma_), body) &&
      (frame_.landmarks().empty() || !tryFit(movedBelief(kMoveSigma, kMoveHeadingSigma), body))) {
    return false;
  }
  if (!frame_.landmarks().empty()) {
    const double distance = (belief_.p_WR - before.p_WR).head<2>().norm();
    const double angle = std::abs(twistAboutZ(belief_.R_WR * before.R_WR.transpose()));
    const auto follow = [](double sigma, double seen, double low, double high) {
      return std::clamp(std::sqrt(0.8 * sigma * sigma + 0.2 * seen * seen), low, high);
    };
    moveSigma_ = follow(moveSigma_, distance, 0.03, kMoveSigma);
    moveHeadingSigma_ = follow(moveHeadingSigma_, angle, 0.03, kMoveHeadingSigma);
  }
  return true;
}

PoseBelief Localization::movedBelief(double positionSigma, double headingSigma) const {
  PoseBelief moved = belief_;
  BeliefMatrix& P = moved.covariance;
  moved.drift.setZero();
  P.middleRows<3>(kDriftState).setZero();
  P.middleCols<3>(kDriftState).setZero();
  for (int i = 0; i < 3; ++i) {
    P(kDriftState + i, kDriftState + i) = kFreeDrift * kFreeDrift;
    const double position = i < 2 ? positionSigma : kMoveHeightSigma;
    const double angle = i < 2 ? kMoveTiltSigma : headingSigma;
    P(kPositionState + i, kPositionState + i) += position * position;
    P(kRotationState + i, kRotationState + i) += angle * angle;
  }
  return moved;
}

bool Localization::challenged() {
  // The particle filter weighs the fit's pose like any other. If another hypothesis explains the frames much
  // better for a while, the fit sits in a wrong place.
  const auto clusters = particles_.clusters();
  if (clusters.empty() || frame_.landmarks().empty()) return false;
  const double own = particles_.logLikelihood(belief_.ground(), ground_, *map_);
  const double best = particles_.logLikelihood(clusters[0].X_WR, ground_, *map_);
  challenges_ = best > own + 8.0 ? challenges_ + 1 : 0;
  return challenges_ > 3;
}

bool Localization::relocate(const BodyState& body) {
  if (tryExpectations(body)) return true;
  if (const auto belief = shiftedByLandmarks(body); belief && tryFit(*belief, body)) return true;
  if (const auto belief = fromLandmarks(body, false); belief && tryFit(*belief, body)) return true;
  // A beam puts a lying robot on its feet, and the body state needs a while to notice.
  const bool tilted = body.R_GR(2, 2) < std::cos(kMoveTiltSigma);
  if (tilted) {
    if (const auto belief = fromLandmarks(body, true); belief && tryFit(*belief, body)) return true;
  }
  if (!settings_.useFilter) return false;
  // Too little for geometry: ask the particles. Lines alone look alike from several places, so they must have
  // agreed for a while.
  const auto clusters = particles_.clusters();
  const bool onlyLines = frame_.landmarks().empty();
  if (clusters.empty() || clusters[0].share < (onlyLines ? 0.95 : 0.8)) return false;
  if (onlyLines && initialised_ && misses_ < kPatience / 2) return false;
  return tryFit(wideBelief(clusters[0].X_WR, 0.5, 0.2, body), body);
}

std::optional<PoseBelief> Localization::shiftedByLandmarks(const BodyState& body) const {
  // The referee moves robots without turning them (server facts 4.8): then one landmark is enough.
  const auto landmarks = frame_.landmarks();
  if (!initialised_ || landmarks.empty()) return std::nullopt;
  const Pose3& X_RC = model::cameraPose(body.bodies);
  Vector3 p_WR = Vector3::Zero();
  for (const ObservedLandmark& seen : landmarks) {
    p_WR += map_->landmark(seen.id) - belief_.R_WR * (X_RC * (seen.at.p_CP - belief_.offset));
  }
  p_WR /= static_cast<double>(landmarks.size());
  PoseBelief belief = wideBelief({p_WR.x(), p_WR.y(), yawOf(belief_.R_WR)}, kFreeSigma, 0.0, body);
  const double heading = belief_.covariance(kRotationState + 2, kRotationState + 2);
  belief.covariance(kRotationState + 2, kRotationState + 2) = heading + kKeptHeadingSigma * kKeptHeadingSigma;
  return belief;
}

std::optional<PoseBelief> Localization::fromLandmarks(const BodyState& body, bool upright) const {
  const auto landmarks = frame_.landmarks();
  if (landmarks.size() < 2) return std::nullopt;
  // Level the observations with the torso's tilt and match them to the map in the plane: the turn and shift
  // with the least squares error have a closed form.
  const Matrix3 level =
      upright ? Matrix3(Matrix3::Identity()) : Matrix3(turnAboutZ(-yawOf(body.R_GR)) * body.R_GR);
  const Pose3& X_RC = model::cameraPose(body.bodies);
  Vector2 seenMean = Vector2::Zero();
  Vector2 mapMean = Vector2::Zero();
  std::array<Vector2, VisionFrame::kMaximumLandmarks> seen;
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    seen[i] = (level * (X_RC * landmarks[i].at.p_CP)).head<2>();
    seenMean += seen[i];
    mapMean += map_->landmark(landmarks[i].id).head<2>();
  }
  seenMean /= static_cast<double>(landmarks.size());
  mapMean /= static_cast<double>(landmarks.size());
  double sine = 0.0;
  double cosine = 0.0;
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    const Vector2 a = seen[i] - seenMean;
    const Vector2 b = map_->landmark(landmarks[i].id).head<2>() - mapMean;
    cosine += a.dot(b);
    sine += a.x() * b.y() - a.y() * b.x();
  }
  Pose2 X_WR(Vector2::Zero(), std::atan2(sine, cosine));
  X_WR.translation = mapMean - X_WR.rotate(seenMean);
  PoseBelief belief = wideBelief(X_WR, kFreeSigma, kFreeHeadingSigma, body);
  if (upright) stand(belief, X_WR.rotation);
  return belief;
}

PoseBelief Localization::wideBelief(const Pose2& X_WR, double positionSigma, double headingSigma,
                                    const BodyState& body) const {
  PoseBelief belief;
  belief.p_WR << X_WR.translation, body.torsoHeight;
  belief.R_WR = turnAboutZ(X_WR.rotation - yawOf(body.R_GR)) * body.R_GR;
  belief.offset = belief_.offset;
  BeliefMatrix& P = belief.covariance;
  P.setZero();
  // Body and camera are not changed by a move, so what is known of the camera's offset stays.
  P.block<3, 3>(kOffsetState, kOffsetState) = belief_.covariance.block<3, 3>(kOffsetState, kOffsetState);
  const double z = 0.3;  // the robot may be held or hang in the air
  for (int i = 0; i < 3; ++i) {
    const double position = i < 2 ? positionSigma : z;
    const double angle = i < 2 ? 2.0 * kMoveTiltSigma : headingSigma;
    P(kPositionState + i, kPositionState + i) = position * position;
    P(kRotationState + i, kRotationState + i) = angle * angle;
    P(kDriftState + i, kDriftState + i) = kFreeDrift * kFreeDrift;
  }
  return belief;
}

void Localization::adopt(const PoseBelief& belief, const BodyState& body) {
  belief_ = belief;
  initialised_ = true;
  misses_ = 0;
  lastCorrection_ = body.time;
  if (!frame_.landmarks().empty()) lastLandmark_ = body.time;
  // Split the orientation into the heading of G and a correction of the torso's tilt.
  const Matrix3 R_WG = belief_.R_WR * body.R_GR.transpose();
  yawOffset_ = twistAboutZ(R_WG);
  tiltCorrection_ = logarithm(turnAboutZ(-yawOffset_) * R_WG);
}

void Localization::followFilter(const BodyState& body) {
  // Without the fit: pose and spread of the heaviest cluster.
  const auto clusters = particles_.clusters();
  if (clusters.empty()) return;
  PoseBelief belief = wideBelief(clusters[0].X_WR, 0.1, 0.1, body);
  const Matrix3& spread = particles_.covariance();
  belief.covariance.block<2, 2>(kPositionState, kPositionState) = spread.topLeftCorner<2, 2>();
  belief.covariance(kRotationState + 2, kRotationState + 2) = spread(2, 2);
  const double lastLandmark = lastLandmark_;
  adopt(belief, body);
  // After a move the particles need a few frames; until then the landmarks contradict their pose.
  const auto seen = static_cast<double>(ground_.landmarkCount + ground_.lineCount);
  if (particles_.logLikelihood(clusters[0].X_WR, ground_, *map_) < -kContradiction * seen) {
    lastLandmark_ = lastLandmark;
  }
}

void Localization::expectPlaces(std::span<const Pose2> X_WR, double time) {
  expectedCount_ = std::min(X_WR.size(), expectedPlaces_.size());
  std::copy_n(X_WR.begin(), expectedCount_, expectedPlaces_.begin());
  expectedSince_ = time;
}

bool Localization::tryExpectations(const BodyState& body) {
  if (body.time - expectedSince_ > kExpectation) return false;
  // The field looks the same from both halves but for the names of its landmarks.
  if (expectedCount_ > 1 && frame_.landmarks().empty()) return false;
  for (std::size_t i = 0; i < expectedCount_; ++i) {
    // Beams scatter by 0.05 m and 10 degrees, uniform (server facts 4.6).
    PoseBelief belief = wideBelief(expectedPlaces_[i], 0.04, 0.12, body);
    stand(belief, expectedPlaces_[i].rotation);
    if (tryFit(belief, body)) return true;
  }
  return false;
}

}  // namespace nonet::world
