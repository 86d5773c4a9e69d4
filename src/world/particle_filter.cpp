#include "nonet/world/particle_filter.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "nonet/math/angle.h"

namespace nonet::world {

namespace {

// The particles are centimetres apart, so the likelihood is blunter than the sensor.
constexpr double kBluntDistance = 0.05;  // m
constexpr double kBluntAngle = 0.01;     // rad
constexpr double kBound = 16.0;          // squared sigmas at which an observation stops to count
constexpr double kClusterRadius = 0.5;   // m
constexpr double kClusterAngle = 0.35;   // rad
constexpr double kBorder = 2.0;          // m around the field in which a robot may be

double informationAt(double distance) {
  const double sigma = kBluntDistance + kBluntAngle * distance;
  return 1.0 / (sigma * sigma);
}

double angleOf(const Vector2& v) {
  return std::atan2(v.y(), v.x());
}

bool near(const Pose2& a, const Pose2& b) {
  return (a.translation - b.translation).squaredNorm() < kClusterRadius * kClusterRadius &&
         std::abs(angleDifference(a.rotation, b.rotation)) < kClusterAngle;
}

/// Squared distance from a point to the painted part of a line, in the plane.
double squaredDistance(const FieldLine& line, const Vector2& p) {
  const Vector2 fromBegin = p - line.begin.head<2>();
  const Vector2 direction = line.direction.head<2>();
  const double along = std::clamp(direction.dot(fromBegin), 0.0, line.length);
  return (fromBegin - along * direction).squaredNorm();
}

}  // namespace

void GroundObservations::assign(const VisionFrame& frame, const Pose3& X_LC, const Vector3& offset,
                                const FieldMap& map, bool useLines) {
  landmarkCount = lineCount = 0;
  const auto ground = [&](const Vector3& p_CP) -> Vector2 { return (X_LC * (p_CP - offset)).head<2>(); };
  for (const ObservedLandmark& seen : frame.landmarks()) {
    const Vector2 place = ground(seen.at.p_CP);
    landmarks[landmarkCount++] = {seen.id, place, informationAt(place.norm())};
  }
  if (!useLines) return;
  for (const ObservedLine& seen : frame.lines()) {
    Segment& segment = lines[lineCount++];
    segment.ends = {ground(seen.ends[0].p_CP), ground(seen.ends[1].p_CP)};
    segment.information = {informationAt(segment.ends[0].norm()), informationAt(segment.ends[1].norm())};
    segment.length = seen.length;
    segment.clipped = seen.clipped;
    segment.candidates = 0;
    const bool whole = !seen.clipped[0] && !seen.clipped[1];
    const double reach = std::max(segment.ends[0].norm(), segment.ends[1].norm());
    const double tolerance = 0.02 + 8.0 * VisionNoise::kAzimuthSigma * reach;
    for (std::size_t k = 0; k < kFieldLineCount; ++k) {
      const double excess = seen.length - map.lines()[k].length;
      if (excess > tolerance || (whole && excess < -tolerance)) continue;
      segment.candidates |= 1U << k;
    }
  }
}

ParticleFilter::ParticleFilter(std::uint64_t seed) : random_(seed) {
  particles_.reserve(kMany);
  next_.reserve(kMany);
  weights_.reserve(kMany);
}

void ParticleFilter::scatter(const FieldMap& map) {
  particles_.resize(kMany);
  const double x = 0.5 * map.geometry().length + kBorder;
  const double y = 0.5 * map.geometry().width + kBorder;
  for (Particle& particle : particles_) {
    const double px = random_.uniform(-x, x);
    const double py = random_.uniform(-y, y);
    particle = {{px, py, random_.uniform(-kPi, kPi)}, 0.0};
  }
  slowFit_ = fastFit_ = 0.0;
  clusterCount_ = 0;
}

void ParticleFilter::insert(const Pose2& X_WR) {
  if (particles_.empty()) return;
  const auto lightest =
      std::min_element(particles_.begin(), particles_.end(),
                       [](const auto& a, const auto& b) { return a.logWeight < b.logWeight; });
  *lightest = {X_WR, 0.0};
}

void ParticleFilter::predict(const Pose2& X_step, double distanceNoise, double angleNoise) {
  for (Particle& particle : particles_) {
    particle.X_WR = particle.X_WR * X_step;
    particle.X_WR.translation.x() += distanceNoise * random_.normal();
    particle.X_WR.translation.y() += distanceNoise * random_.normal();
    particle.X_WR.rotation = wrapAngle(particle.X_WR.rotation + angleNoise * random_.normal());
  }
}

double ParticleFilter::logLikelihood(const Pose2& X_WR, const GroundObservations& seen,
                                     const FieldMap& map) const {
  const double c = std::cos(X_WR.rotation);
  const double s = std::sin(X_WR.rotation);
  const auto toField = [&](const Vector2& p) -> Vector2 {
    return {X_WR.translation.x() + c * p.x() - s * p.y(), X_WR.translation.y() + s * p.x() + c * p.y()};
  };
  double cost = 0.0;
  for (const GroundObservations::Point& point : seen.points()) {
    const Vector2 difference = toField(point.p_LP) - map.landmark(point.id).head<2>();
    cost += std::min(difference.squaredNorm() * point.information, 2.0 * kBound);
  }
  for (const GroundObservations::Segment& segment : seen.segments()) {
    const std::array<Vector2, 2> ends{toField(segment.ends[0]), toField(segment.ends[1])};
    double best = kBound;
    for (std::uint32_t bits = segment.candidates; bits != 0; bits &= bits - 1) {
      const FieldLine& line = map.lines()[static_cast<std::size_t>(std::countr_zero(bits))];
      double sum = 0.0;
      for (std::size_t side = 0; side < 2 && sum < best; ++side) {
        const Vector2 target = (side == 0 ? line.begin : line.end).head<2>();
        const double squared =
            segment.clipped[side] ? squaredDistance(line, ends[side]) : (ends[side] - target).squaredNorm();
        sum += squared * segment.information[side];
      }
      best = std::min(best, sum);
    }
    cost += best;
  }
  return -0.5 * cost;
}

void ParticleFilter::correct(const GroundObservations& seen, const FieldMap& map, bool tracking) {
  const std::size_t observations = seen.landmarkCount + seen.lineCount;
  if (observations == 0 || particles_.empty()) return;
  double largest = -1e300;
  for (Particle& particle : particles_) {
    particle.logWeight += logLikelihood(particle.X_WR, seen, map);
    largest = std::max(largest, particle.logWeight);
  }
  weights_.clear();
  double sum = 0.0;
  double squares = 0.0;
  for (Particle& particle : particles_) {
    particle.logWeight -= largest;
    weights_.push_back(std::exp(particle.logWeight));
    sum += weights_.back();
    squares += weights_.back() * weights_.back();
  }
  effectiveSize_ = sum * sum / squares;
  findClusters();

  // How well the best hypothesis explains the frame, per observation; the averages tell a sudden change.
  const double fit =
      clusterCount_ > 0
          ? std::exp(logLikelihood(clusters_[0].X_WR, seen, map) / static_cast<double>(observations))
          : 0.0;
  slowFit_ += 0.05 * (fit - slowFit_);
  fastFit_ += 0.3 * (fit - fastFit_);
  const std::size_t count = tracking ? kFew : kMany;
  if (effectiveSize_ < 0.5 * static_cast<double>(particles_.size()) || particles_.size() != count) {
    resample(count);
  }
  double fresh = tracking ? 0.1 : 0.1 + 0.4 * (1.0 - fit);
  if (slowFit_ > 1e-6) fresh = std::max(fresh, std::min(0.5, 1.0 - fastFit_ / slowFit_));
  if (!(fresh >= 0.0)) fresh = 0.5;  // not a number: nothing of what there is can be trusted
  const auto replaced = static_cast<std::size_t>(fresh * static_cast<double>(particles_.size()));
  for (std::size_t i = 0; i < replaced; ++i) {
    // Evenly spaced victims: resampling keeps the copies of one particle together, so no hypothesis dies.
    const std::size_t victim = i * particles_.size() / replaced;
    particles_[victim] = {this->seed(seen, map), -2.0};
  }
}

void ParticleFilter::resample(std::size_t count) {
  // Low-variance resampling [Thrun 2005, table 4.4].
  double total = 0.0;
  for (const double weight : weights_) total += weight;
  const double step = total / static_cast<double>(count);
  double pointer = random_.uniform() * step;
  double reached = weights_[0];
  std::size_t index = 0;
  next_.clear();
  for (std::size_t i = 0; i < count; ++i) {
    while (reached < pointer && index + 1 < weights_.size()) reached += weights_[++index];
    next_.push_back({particles_[index].X_WR, 0.0});
    pointer += step;
  }
  particles_.swap(next_);
}

Pose2 ParticleFilter::seed(const GroundObservations& seen, const FieldMap& map) {
  const auto points = seen.points();
  const auto segments = seen.segments();
  if (points.size() >= 2) {
    // Two named points fix the pose.
    const std::size_t i = random_.below(points.size());
    const std::size_t j = (i + 1 + random_.below(points.size() - 1)) % points.size();
    const Vector2 a = map.landmark(points[i].id).head<2>();
    const Vector2 b = map.landmark(points[j].id).head<2>();
    const double turn = wrapAngle(angleOf(b - a) - angleOf(points[j].p_LP - points[i].p_LP));
    Pose2 X_WR(Vector2::Zero(), turn);
    X_WR.translation = 0.5 * (a + b) - X_WR.rotate(0.5 * (points[i].p_LP + points[j].p_LP));
    return X_WR;
  }
  double turn = random_.uniform(-kPi, kPi);
  const GroundObservations::Segment* segment = nullptr;
  const FieldLine* line = nullptr;
  if (!segments.empty()) {
    segment = &segments[random_.below(segments.size())];
    if (segment->candidates != 0) {
      std::uint32_t bits = segment->candidates;
      for (std::uint64_t skip = random_.below(static_cast<std::uint64_t>(std::popcount(bits))); skip > 0;
           --skip) {
        bits &= bits - 1;
      }
      line = &map.lines()[static_cast<std::size_t>(std::countr_zero(bits))];
      const Vector2 direction = line->direction.head<2>();
      turn = angleOf(direction) - angleOf(segment->ends[1] - segment->ends[0]);
      // Both ends cut: the server may have swapped them.
      if (segment->clipped[0] && segment->clipped[1] && random_.below(2) == 0) turn += kPi;
      turn = wrapAngle(turn);
    }
  }
  Pose2 X_WR(Vector2::Zero(), turn);
  if (!points.empty()) {
    X_WR.translation = map.landmark(points[0].id).head<2>() - X_WR.rotate(points[0].p_LP);
    return X_WR;
  }
  if (line != nullptr) {
    const std::size_t side = segment->clipped[0] ? 1 : 0;
    Vector2 target = (side == 0 ? line->begin : line->end).head<2>();
    if (segment->clipped[side]) {
      target = line->begin.head<2>() + random_.uniform(0.0, line->length) * line->direction.head<2>();
    }
    X_WR.translation = target - X_WR.rotate(segment->ends[side]);
    return X_WR;
  }
  const double x = 0.5 * map.geometry().length + kBorder;
  const double y = 0.5 * map.geometry().width + kBorder;
  X_WR.translation.x() = random_.uniform(-x, x);
  X_WR.translation.y() = random_.uniform(-y, y);
  return X_WR;
}

void ParticleFilter::findClusters() {
  clusterCount_ = 0;
  double total = 0.0;
  for (const double weight : weights_) total += weight;
  while (clusterCount_ < clusters_.size()) {
    // The heaviest particle that belongs to no cluster yet.
    const Particle* center = nullptr;
    double heaviest = 0.0;
    for (std::size_t i = 0; i < particles_.size(); ++i) {
      if (weights_[i] <= heaviest) continue;
      bool taken = false;
      for (std::size_t k = 0; k < clusterCount_; ++k) taken |= near(particles_[i].X_WR, clusters_[k].X_WR);
      if (taken) continue;
      center = &particles_[i];
      heaviest = weights_[i];
    }
    if (center == nullptr || heaviest < 1e-9 * total) break;
    Vector3 mean = Vector3::Zero();
    double weight = 0.0;
    const auto difference = [&](const Pose2& pose) {
      const Vector2 p = pose.translation - center->X_WR.translation;
      return Vector3(p.x(), p.y(), angleDifference(pose.rotation, center->X_WR.rotation));
    };
    for (std::size_t i = 0; i < particles_.size(); ++i) {
      if (!near(particles_[i].X_WR, center->X_WR)) continue;
      mean += weights_[i] * difference(particles_[i].X_WR);
      weight += weights_[i];
    }
    mean /= weight;
    if (clusterCount_ == 0) {
      covariance_ = Matrix3::Identity() * 1e-4;
      for (std::size_t i = 0; i < particles_.size(); ++i) {
        if (!near(particles_[i].X_WR, center->X_WR)) continue;
        const Vector3 d = difference(particles_[i].X_WR) - mean;
        covariance_ += weights_[i] / weight * d * d.transpose();
      }
    }
    Cluster& cluster = clusters_[clusterCount_++];
    cluster.X_WR =
        Pose2(center->X_WR.translation + mean.head<2>(), wrapAngle(center->X_WR.rotation + mean.z()));
    cluster.share = weight / total;
  }
}

}  // namespace nonet::world
